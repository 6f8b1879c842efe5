#include "app/gui/actions/point_actions.h"

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/number_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {

PointActions::PointActions(const Workspace& workspace, PointOptions& options)
    : QObject(&workspace.window), workspace_(workspace), options_(options) {
  Menus& menus = workspace_.menus;
  menus.edit->addSeparator();
  actions_ = {
      menus.add(menus.edit,
                {"move", tr("Move &by …"), QKeySequence(Qt::CTRL | Qt::Key_M),
                 tr("Move the selected points by an exact vector")},
                this, &PointActions::moveBy),
      menus.add(menus.edit,
                {nullptr, tr("Move &to …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_M),
                 tr("Move the selected points so that their middle lies at an exact place")},
                this, &PointActions::moveTo),
      menus.add(menus.edit,
                {"move-normal",
                 tr("Move along &normal …"),
                 {},
                 tr("Move each selected point along its own outward normal")},
                this, &PointActions::moveAlongNormal)};
  QMenu* plane = menus.edit->addMenu(icon("align"), tr("&Align to plane"));
  plane->setToolTipsVisible(true);
  const auto addAlign = [&](const QString& text, const QString& tip,
                            std::optional<Eigen::Vector3d> normal) {
    actions_.push_back(
        menus.add(plane, {nullptr, text, {}, tip}, this, [this, normal] { align(normal); }));
  };
  addAlign(tr("&Best fit"), tr("Move the points into the plane nearest to all of them"), {});
  const QString tip = tr("Move the points into the plane across %1 through their middle");
  addAlign(tr("Across &x"), tip.arg("x"), Eigen::Vector3d::UnitX());
  addAlign(tr("Across &y"), tip.arg("y"), Eigen::Vector3d::UnitY());
  addAlign(tr("Across &z"), tip.arg("z"), Eigen::Vector3d::UnitZ());
  QAction* snap = menus.addToggle(
      menus.edit,
      {nullptr, tr("Snap &while moving"), QKeySequence(Qt::Key_F9),
       tr("Dragged points go to control points, edges and the grid; Ctrl reverses it")},
      options.snaps(), this, [this](bool on) { options_.setSnaps(on); });
  connect(&options_, &PointOptions::changed, snap,
          [this, snap] { snap->setChecked(options_.snaps()); });
  connect(&workspace_.editor, &Editor::selectionChanged, this, &PointActions::update);
  connect(&workspace_.editor, &Editor::projectReplaced, this, &PointActions::update);
  update();
}

std::set<int> PointActions::points() const {
  const modeling::Solid* solid = workspace_.editor.solid();
  return solid ? pointsOf(workspace_.editor.selection(), *solid) : std::set<int>();
}

void PointActions::update() {
  const bool can = !points().empty();
  for (QAction* action : actions_) action->setEnabled(can);
}

void PointActions::moveBy() {
  const std::set<int> moved = points();
  if (moved.empty()) return;
  NumberDialog dialog(tr("Move by"), tr("Control points that are moved: %1.").arg(moved.size()),
                      workspace_.settings, &workspace_.window);
  VectorEdit& vector = dialog.addVector(tr("&Vector:"), Eigen::Vector3d::Zero());
  if (dialog.exec() == QDialog::Accepted)
    workspace_.editor.perform(modeling::MovePoints{
        modeling::PointSelection::of({moved.begin(), moved.end()}),
        modeling::MoveBy{vector.value()}, options_.reach(*workspace_.editor.solid())});
}

void PointActions::moveTo() {
  const std::set<int> moved = points();
  if (moved.empty()) return;
  const modeling::Solid& solid = *workspace_.editor.solid();
  const Eigen::Vector3d from = meanOf(moved, solid);
  NumberDialog dialog(
      tr("Move to"),
      moved.size() == 1 ? tr("Moves control point %1 to this place.").arg(*moved.begin())
                        : tr("Moves %1 control points; their middle comes here.").arg(moved.size()),
      workspace_.settings, &workspace_.window);
  VectorEdit& place = dialog.addVector(tr("&Place:"), from);
  if (dialog.exec() != QDialog::Accepted) return;
  modeling::MovePoints command{modeling::PointSelection::of({moved.begin(), moved.end()}),
                               modeling::MoveBy{place.value() - from}, options_.reach(solid)};
  // A single point gets exactly the typed numbers, without rounding of a sum.
  if (moved.size() == 1) command.how = modeling::MoveTo{{place.value()}};
  workspace_.editor.perform(command);
}

void PointActions::moveAlongNormal() {
  const std::set<int> moved = points();
  if (moved.empty()) return;
  NumberDialog dialog(tr("Move along normal"),
                      tr("Each selected control point goes along its own outward normal; below "
                         "zero inwards. Points: %1.")
                          .arg(moved.size()),
                      workspace_.settings, &workspace_.window);
  QuantityEdit& distance = dialog.addLength(tr("&Distance:"), 0);
  if (dialog.exec() == QDialog::Accepted)
    workspace_.editor.perform(modeling::MovePoints{
        modeling::PointSelection::of({moved.begin(), moved.end()}),
        modeling::MoveAlongNormal{distance.value()}, options_.reach(*workspace_.editor.solid())});
}

void PointActions::align(std::optional<Eigen::Vector3d> normal) {
  const std::set<int> moved = points();
  if (moved.empty()) return;
  workspace_.editor.perform(modeling::AlignPoints{
      modeling::PointSelection::of({moved.begin(), moved.end()}), normal, {}});
}

}  // namespace palpa::gui

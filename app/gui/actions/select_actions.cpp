#include "app/gui/actions/select_actions.h"

#include <QActionGroup>
#include <QInputDialog>

#include "app/gui/dialogs/selection_sets_dialog.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {
namespace {

using Pick = PointOptions::Pick;

std::set<int> upTo(std::size_t count) {
  std::set<int> all;
  for (std::size_t i = 0; i < count; ++i) all.insert(all.end(), static_cast<int>(i));
  return all;
}

std::set<int> without(std::set<int> all, const std::set<int>& some) {
  for (int each : some) all.erase(each);
  return all;
}

}  // namespace

SelectActions::SelectActions(const Workspace& workspace, PointOptions& options)
    : QObject(&workspace.window),
      workspace_(workspace),
      options_(options),
      sets_(new SelectionSets(workspace.editor, this)) {
  workspace_.menus.select->addSeparator();
  addPicks();
  workspace_.menus.select->addSeparator();
  addSelections();
  workspace_.menus.select->addSeparator();
  addSets();
  connect(&workspace_.editor, &Editor::selectionChanged, this, &SelectActions::update);
  connect(&workspace_.editor, &Editor::projectReplaced, this, &SelectActions::update);
  connect(&workspace_.editor, &Editor::projectChanged, this, &SelectActions::update);
  update();
}

void SelectActions::addPicks() {
  auto* group = new QActionGroup(this);
  for (const PointOptions::PickInfo& info : PointOptions::pickInfos()) {
    QAction* action = workspace_.menus.add(workspace_.menus.select,
                                           {info.icon, info.menuText, info.key, info.tip}, this,
                                           [this, pick = info.pick] { options_.setPick(pick); });
    action->setCheckable(true);
    group->addAction(action);
    const auto show = [this, action, pick = info.pick] {
      action->setChecked(options_.pick() == pick);
    };
    connect(&options_, &PointOptions::changed, action, show);
    show();
  }
}

void SelectActions::addSelections() {
  Menus& menus = workspace_.menus;
  const auto selectPoints =
      [this](std::set<int> (*change)(const std::set<int>&, const modeling::Solid&)) {
        return [this, change] {
          Editor& editor = workspace_.editor;
          if (!editor.solid()) return;
          const std::set<int> points = pointsOf(editor.selection(), *editor.solid());
          editor.select(Selection::ofPoints(change(points, *editor.solid())));
        };
      };
  needSolid_.push_back(menus.add(menus.select,
                                 {nullptr, tr("&All"), QKeySequence::SelectAll,
                                  tr("Select all points, patches or edges, as picked")},
                                 this, &SelectActions::selectAll));
  menus.add(
      menus.select,
      {nullptr, tr("&None"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_A), tr("Select nothing")},
      this, [this] { workspace_.editor.select({}); });
  needSolid_.push_back(menus.add(menus.select,
                                 {nullptr, tr("&Invert"), QKeySequence(Qt::CTRL | Qt::Key_I),
                                  tr("Select everything else instead")},
                                 this, &SelectActions::invert));
  needPoints_.push_back(menus.add(menus.select,
                                  {nullptr, tr("&Grow"), QKeySequence(Qt::CTRL | Qt::Key_G),
                                   tr("Add the neighbours in the control nets")},
                                  this, selectPoints(&grown)));
  needPoints_.push_back(
      menus.add(menus.select,
                {nullptr, tr("S&hrink"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_G),
                 tr("Remove the points at the rim of the selection")},
                this, selectPoints(&shrunk)));
  needPoints_.push_back(menus.add(
      menus.select,
      {nullptr,
       tr("Points &of patches and edges"),
       {},
       tr("Select the points of the selected patches and edges")},
      this,
      selectPoints([](const std::set<int>& points, const modeling::Solid&) { return points; })));
}

void SelectActions::addSets() {
  Menus& menus = workspace_.menus;
  name_ =
      menus.add(menus.select,
                {nullptr, tr("Na&me selection …"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_N),
                 tr("Name the selected points, patches or edges, to select them again later")},
                this, [this] { nameSelection(); });
  chooseSet_ = menus.select->addMenu(tr("Named &selections"));
  chooseSet_->setObjectName("namedSelections");
  connect(chooseSet_, &QMenu::aboutToShow, this, &SelectActions::fillSets);
  manageSets_ = menus.add(menus.select,
                          {nullptr,
                           tr("Mana&ge named selections …"),
                           {},
                           tr("Select, rename and delete named selections")},
                          this, [this] { SelectionSetsDialog(*sets_, &workspace_.window).exec(); });
  connect(sets_, &SelectionSets::changed, this, &SelectActions::update);
}

void SelectActions::fillSets() {
  chooseSet_->clear();
  for (const QString& name : sets_->names()) {
    QAction* action =
        chooseSet_->addAction(QString(name).replace("&", "&&") + "\t" + sets_->contentOf(name),
                              this, [this, name] { sets_->choose(name); });
    action->setObjectName(name);
  }
}

void SelectActions::nameSelection() {
  QStringList names = sets_->names();
  names.prepend(sets_->freeName());
  bool isNamed = false;
  const QString name = QInputDialog::getItem(&workspace_.window, tr("Name selection"),
                                             tr("Name (a name in use gets the new selection):"),
                                             names, 0, true, &isNamed);
  if (!isNamed || name.trimmed().isEmpty()) return;
  sets_->put(name);
  Q_EMIT workspace_.editor.said(
      tr("The selection is named \"%1\" (Select > Named selections)").arg(name.trimmed()));
}

void SelectActions::selectAll() {
  const modeling::Solid* solid = workspace_.editor.solid();
  if (!solid) return;
  workspace_.editor.select(
      options_.pick() == Pick::kPatches ? Selection::ofPatches(upTo(solid->patches().size()))
      : options_.pick() == Pick::kEdges ? Selection::ofEdges(upTo(solid->edges().size()))
                                        : Selection::ofPoints(allPoints(*solid)));
}

void SelectActions::invert() {
  const modeling::Solid* solid = workspace_.editor.solid();
  if (!solid) return;
  const Selection& now = workspace_.editor.selection();
  if (!now.patches.empty())
    workspace_.editor.select(
        Selection::ofPatches(without(upTo(solid->patches().size()), now.patches)));
  else if (!now.edges.empty())
    workspace_.editor.select(Selection::ofEdges(without(upTo(solid->edges().size()), now.edges)));
  else if (!now.points.empty())
    workspace_.editor.select(Selection::ofPoints(inverted(now.points, *solid)));
  else
    selectAll();
}

void SelectActions::update() {
  const Editor& editor = workspace_.editor;
  const Selection& now = editor.selection();
  const bool hasPoints =
      editor.solid() && (!now.points.empty() || !now.patches.empty() || !now.edges.empty());
  for (QAction* action : needSolid_) action->setEnabled(editor.solid() != nullptr);
  for (QAction* action : needPoints_) action->setEnabled(hasPoints);
  name_->setEnabled(sets_->canName());
  chooseSet_->menuAction()->setEnabled(!sets_->names().isEmpty());
  manageSets_->setEnabled(!sets_->names().isEmpty());
}

}  // namespace palpa::gui

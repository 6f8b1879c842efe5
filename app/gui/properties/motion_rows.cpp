#include <QGridLayout>
#include <QPushButton>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/core/design/design_space.h"
#include "app/gui/base/translate.h"
#include "app/gui/document/design_edit.h"
#include "app/gui/document/design_words.h"
#include "app/gui/properties/design_rows.h"
#include "app/gui/widgets/vector_edit.h"
#include "base/error.h"

namespace palpa::gui {
namespace {

using modeling::Design;
using modeling::PointSelection;

constexpr double kMinDesignLength = 1e-9, kMaxDesignLength = 1e9;  // mm
constexpr double kNoLength = std::numeric_limits<double>::quiet_NaN();
constexpr double kPerCent = 0.01;

template <class Member>
auto designReader(Editor& editor, Member Design::*member) {
  return [&editor, member] { return designOf(editor.project()).*member; };
}

template <class Value, class Member>
auto designWriter(Editor& editor, Member Design::*member) {
  return [&editor, member](const Value& value) {
    return editDesign(editor, [&](Design& design) { design.*member = static_cast<Member>(value); });
  };
}

/// Row of an optional length; empty for none.
QuantityEdit* addOptionalLength(PropertyPage& page, const QString& label, const QString& name,
                                std::optional<double> Design::*member, const QString& placeholder) {
  Editor& editor = page.editor();
  QuantityEdit* edit = page.addQuantity(
      label, name, Quantity::kLength,
      [&editor, member] { return (designOf(editor.project()).*member).value_or(kNoLength); },
      [&editor, member](double value) {
        return editDesign(editor, [&](Design& design) {
          design.*member = std::isnan(value) ? std::nullopt : std::optional(value);
        });
      });
  edit->setRange(kMinDesignLength, kMaxDesignLength);
  edit->setOptional(placeholder);
  return edit;
}

/// The selected points or patches of the view as a selection of a design; none without any.
std::optional<PointSelection> selectedInView(const Editor& editor) {
  const Selection& selection = editor.selection();
  if (!selection.points.empty())
    return PointSelection::of({selection.points.begin(), selection.points.end()});
  if (selection.patches.empty() || !editor.solid()) return std::nullopt;
  modeling::PatchPoints patches;
  for (const int patch : selection.patches)
    patches.patches.push_back(editor.solid()->patches()[static_cast<std::size_t>(patch)].name);
  return PointSelection{{std::move(patches)}};
}

/// Selects the points that the search would move.
void selectMovable(Editor& editor) {
  if (!editor.solid()) return;
  const Design design = designOf(editor.project());
  try {
    const app::DesignSpace space(editor.project(), design);
    editor.select(Selection::ofPoints({space.points().begin(), space.points().end()}));
  } catch (const Error& error) {
    Q_EMIT editor.refused(designProblem(QString::fromStdString(error.what()), design));
  }
}

/// Buttons that change which points may move.
void addMovingPoints(PropertyPage& page) {
  Editor& editor = page.editor();
  QLabel* fact = page.addFact(tr("Points"), "movingPoints",
                              [&editor] { return pointsText(designOf(editor.project()).points); });
  page.explain(fact, tr("Control points that the search may move"));
  auto* buttons = new QWidget(&page);
  auto* grid = new QGridLayout(buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const QString& text, const char* name, const QString& tip, int row,
                       int column, std::function<void()> work) {
    auto* button = new QPushButton(text, buttons);
    button->setObjectName(name);
    button->setToolTip(tip);
    button->setAutoDefault(false);
    QObject::connect(button, &QPushButton::clicked, &page, std::move(work));
    grid->addWidget(button, row, column);
    return button;
  };
  QPushButton* use =
      add(tr("Move the selected"), "moveSelected",
          tr("Only the points or patches selected in the view may move"), 0, 0, [&editor] {
            if (const auto chosen = selectedInView(editor))
              editDesign(editor, [&](Design& design) { design.points = chosen; });
          });
  QPushButton* keep = add(
      tr("Keep the selected"), "keepSelected",
      tr("All points may move except the points or patches selected in the view"), 0, 1, [&editor] {
        if (const auto chosen = selectedInView(editor))
          editDesign(editor, [&](Design& design) {
            design.points = PointSelection{{modeling::NoneOf{{*chosen}}}};
          });
      });
  QPushButton* all =
      add(tr("Usual points"), "moveUsual", tr("All points outside patches that supports fix"), 1, 0,
          [&editor] { editDesign(editor, [](Design& design) { design.points.reset(); }); });
  add(tr("Show them"), "selectMoving", tr("Select in the view the points that may move"), 1, 1,
      [&editor] { selectMovable(editor); });
  const auto update = [&editor, use, keep, all] {
    const bool hasSelection = selectedInView(editor).has_value();
    const bool hasPoints = designOf(editor.project()).points.has_value();
    const QString reason = tr("Select control points or patches in the view first");
    use->setEnabled(hasSelection);
    keep->setEnabled(hasSelection);
    use->setToolTip(hasSelection ? tr("Only the points or patches selected in the view may move")
                                 : reason);
    keep->setToolTip(
        hasSelection ? tr("All points may move except the points or patches selected in the view")
                     : reason);
    all->setEnabled(hasPoints);
  };
  QObject::connect(&editor, &Editor::selectionChanged, buttons, update);
  QObject::connect(&editor, &Editor::projectChanged, buttons, update);
  update();
  page.addWidget(buttons);
}

void addDirectionRows(PropertyPage& page) {
  Editor& editor = page.editor();
  QComboBox* along = page.addChoice(
      tr("&Along"), "movesAlong",
      {tr("the normal of the surface"), tr("any direction"), tr("one direction")},
      [&editor] { return static_cast<int>(designOf(editor.project()).along); },
      designWriter<int>(editor, &Design::along));
  page.explain(along, tr("Directions in which control points may move"));
  if (designOf(editor.project()).along == Design::Along::kDirection)
    page.addVector(tr("&Direction x, y, z"), "movesDirection", Quantity::kNumber,
                   designReader(editor, &Design::direction),
                   designWriter<Eigen::Vector3d>(editor, &Design::direction));
  page.explain(addOptionalLength(page, tr("&Largest movement"), "largestMovement",
                                 &Design::largestMovement, tr("a tenth of the size")),
               tr("Of a control point, from where it is now. Empty: a tenth of the diagonal of the "
                  "body's box"));
}

/// Axis of a plane that is perpendicular to it; none for a slanting plane.
std::optional<int> axisOf(const modeling::MirrorPlane& plane) {
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d others = plane.normal;
    others[axis] = 0;
    if (others.isZero(0) && plane.normal[axis] != 0) return axis;
  }
  return std::nullopt;
}

bool isSlanting(const modeling::MirrorPlane& plane) {
  return !axisOf(plane);
}

void addMirrorRow(PropertyPage& page, int axis) {
  Editor& editor = page.editor();
  const QString letter = QString(QChar('x' + axis));
  QuantityEdit* edit = page.addQuantity(
      tr("Mirror plane at %1").arg(letter), "mirror-" + letter, Quantity::kLength,
      [&editor, axis] {
        for (const modeling::MirrorPlane& plane : designOf(editor.project()).mirrors)
          if (axisOf(plane) == axis) return plane.point[axis];
        return kNoLength;
      },
      [&editor, axis](double at) {
        return editDesign(editor, [&](Design& design) {
          auto& planes = design.mirrors;
          const auto old = std::find_if(planes.begin(), planes.end(),
                                        [&](const auto& plane) { return axisOf(plane) == axis; });
          if (std::isnan(at)) {
            if (old != planes.end()) planes.erase(old);
            return;
          }
          const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
          const modeling::MirrorPlane plane{at * normal, normal};
          if (old != planes.end())
            *old = plane;
          else
            planes.push_back(plane);
        });
      });
  edit->setRange(-kMaxDesignLength, kMaxDesignLength);
  edit->setOptional(tr("none"));
  page.explain(edit, tr("The body is symmetric about this plane and stays so; 0 for the plane "
                        "through the origin. Empty: no symmetry"));
}

void addMirrorRows(PropertyPage& page) {
  Editor& editor = page.editor();
  for (int axis = 0; axis < 3; ++axis) addMirrorRow(page, axis);
  const auto& planes = designOf(editor.project()).mirrors;
  const auto slanting = std::count_if(planes.begin(), planes.end(), isSlanting);
  if (slanting == 0) return;
  page.addNote(
      slanting == 1
          ? tr("A slanting mirror plane from the project file also counts.")
          : tr("%1 slanting mirror planes from the project file also count.").arg(slanting));
  page.addButton(tr("Remove slanting planes"), "removeSlanting", "delete", [&editor] {
    editDesign(editor, [](Design& design) { std::erase_if(design.mirrors, isSlanting); });
  });
}

}  // namespace

QString motionKey(const Editor& editor) {
  const Design design = designOf(editor.project());
  const auto slanting = std::count_if(design.mirrors.begin(), design.mirrors.end(), isSlanting);
  return QStringLiteral("%1 %2").arg(static_cast<int>(design.along)).arg(slanting);
}

void addMotionRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("What may move"));
  addMovingPoints(page);
  addDirectionRows(page);
  addMirrorRows(page);
  page.addSection(tr("Limits"));
  QComboBox* volume = page.addChoice(
      tr("&Volume"), "designVolume",
      {tr("may change"), tr("is kept"), tr("must not grow"), tr("as small as possible")},
      [&editor] { return static_cast<int>(designOf(editor.project()).volume); },
      designWriter<int>(editor, &Design::volume));
  page.explain(volume, tr("The mass goes with the volume"));
  page.explain(addOptionalLength(page, tr("Smallest &thickness"), "smallestThickness",
                                 &Design::smallestThickness, tr("no limit")),
               tr("Walls must not become thinner; places that are thinner already may stay so"));
  QuantityEdit* smoothness = page.addQuantity(tr("&Smoothness"), "smoothness", Quantity::kNumber,
                                              designReader(editor, &Design::smoothness),
                                              designWriter<double>(editor, &Design::smoothness));
  smoothness->setRange(0, Design::kMaxSmoothness);
  page.explain(smoothness, tr("0 lets each control point move alone; larger numbers give broader, "
                              "calmer changes. 1 is usual"));
  page.addSection(tr("Search"));
  QuantityEdit* tolerance = page.addQuantity(
      tr("T&olerance, %"), "designTolerance", Quantity::kNumber,
      [&editor] { return designOf(editor.project()).tolerance / kPerCent; },
      [&editor](double value) {
        return editDesign(editor, [&](Design& design) { design.tolerance = value * kPerCent; });
      });
  tolerance->setRange(Design::kMinTolerance / kPerCent, Design::kMaxTolerance / kPerCent);
  page.explain(tolerance, tr("Relative error of a target that is good enough"));
  QSpinBox* steps = page.addCount(tr("At most st&eps"), "designSteps", 1, Design::kMaxSteps,
                                  designReader(editor, &Design::steps),
                                  designWriter<int>(editor, &Design::steps));
  page.explain(steps, tr("Shapes that the search may compute; each is a full build"));
}

}  // namespace palpa::gui

#include <QCoreApplication>
#include <array>

#include "app/gui/document/naming.h"
#include "app/gui/properties/pages.h"
#include "app/gui/document/editor.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using modeling::Load;
using modeling::Support;
using modeling::Touch;

QString tr(const char* text) {
  return QCoreApplication::translate("Properties", text);
}

/// The selected one; a default when it is just going.
template <class One>
One selected(const Editor& editor, const std::vector<One>& list) {
  if (editor.selection().named)
    for (const One& each : list)
      if (each.name == editor.selection().named->name) return each;
  return {};
}

Support supportOf(const Editor& editor) {
  return selected(editor, editor.project().supports);
}
Load loadOf(const Editor& editor) {
  return selected(editor, editor.project().loads);
}
Touch touchOf(const Editor& editor) {
  return selected(editor, editor.project().touches);
}

bool put(Editor& editor, const Support& support) {
  return editor.perform(modeling::SetSupport{support.name, support});
}
bool put(Editor& editor, const Load& load) {
  return editor.perform(modeling::SetLoad{load.name, load});
}
bool put(Editor& editor, const Touch& touch) {
  return editor.perform(modeling::SetTouch{touch.name, touch});
}

void addName(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addText(
      tr("&Name"), "name",
      [&editor] {
        const auto& named = editor.selection().named;
        return named ? QString::fromStdString(named->name) : QString();
      },
      [&editor](const QString& name) {
        return !editor.selection().named || renameNamed(editor, *editor.selection().named, name);
      });
}

/// Reads and writes a member of the variant in a load; the page is made anew when it is of another
/// kind.
template <class What, class Member>
auto reader(Editor& editor, Member What::*member) {
  return [&editor, member] {
    const Load load = loadOf(editor);
    const auto* what = std::get_if<What>(&load.what);
    return what ? what->*member : What().*member;
  };
}

template <class What, class Member>
auto writer(Editor& editor, Member What::*member) {
  return [&editor, member](const Member& value) {
    Load load = loadOf(editor);
    auto* what = std::get_if<What>(&load.what);
    if (!what) return false;
    what->*member = value;
    return put(editor, load);
  };
}

using Action = decltype(Touch::action);

/// The action of another kind that comes nearest: direction and friction stay. Millimetres are no
/// newtons, so a length of one is begun with; a pin begins where it is.
Action withKind(const Touch& touch, int kind) {
  using namespace modeling;
  const Vector3d& vector = vectorOf(touch);
  const bool wasForce = std::holds_alternative<TouchForce>(touch.action);
  const Vector3d moved = wasForce ? Vector3d(vector.stableNormalized()) : vector;
  const double* friction = frictionOf(touch);
  const double kept = friction ? *friction : 0.0;
  const std::array<Action, std::variant_size_v<Action>> ofKind{
      TouchDisplacement{moved}, TouchForce{vector.stableNormalized()}, TouchPush{moved, kept},
      TouchProbe{moved, kept}, TouchPin{}};
  return ofKind[kind];
}

/// What the displacement is measured from.
QString displacementNote(const Touch& touch) {
  using namespace modeling;
  if (std::holds_alternative<TouchForce>(touch.action)) return {};
  if (std::holds_alternative<TouchDisplacement>(touch.action))
    return tr("From the unloaded shape.");
  if (std::holds_alternative<TouchPin>(touch.action))
    return tr("From where supports and loads alone leave the place.");
  return tr("From where the tool first meets the surface.");
}

bool setFriction(Editor& editor, double friction) {
  Touch touch = touchOf(editor);
  if (auto* push = std::get_if<modeling::TouchPush>(&touch.action)) push->friction = friction;
  if (auto* probe = std::get_if<modeling::TouchProbe>(&touch.action)) probe->friction = friction;
  return put(editor, touch);
}

void addTouchRadius(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addCheck(
      tr("As wide as a &fingertip usually is"), "usualRadius",
      [&editor] { return !touchOf(editor).radius.has_value(); },
      [&editor](bool isUsual) {
        Touch touch = touchOf(editor);
        touch.radius = isUsual ? std::nullopt : std::optional(5.0);
        return put(editor, touch);
      });
  if (!touchOf(editor).radius) return;
  page.addQuantity(
      tr("&Radius"), "radius", Quantity::kLength,
      [&editor] { return touchOf(editor).radius.value_or(0.0); },
      [&editor](double radius) {
        Touch touch = touchOf(editor);
        touch.radius = radius;
        return put(editor, touch);
      });
}

}  // namespace

void addSupportRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Support"));
  addName(page);
  page.addChoice(
      tr("&Kind"), "kind", {tr("Fixed"), tr("Roller: slides along the surface")},
      [&editor] { return supportOf(editor).kind == Support::Kind::kFixed ? 0 : 1; },
      [&editor](int kind) {
        Support support = supportOf(editor);
        support.kind = kind == 0 ? Support::Kind::kFixed : Support::Kind::kRoller;
        return put(editor, support);
      });
  page.addVector(
      tr("&Displacement x, y, z"), "displacement", Quantity::kLength,
      [&editor] { return supportOf(editor).displacement; },
      [&editor](const Vector3d& displacement) {
        Support support = supportOf(editor);
        support.displacement = displacement;
        return put(editor, support);
      });
  addRegionRows(
      page, [&editor] { return supportOf(editor).where; },
      [&editor](const modeling::Region& where) {
        Support support = supportOf(editor);
        support.where = where;
        return put(editor, support);
      });
}

void addLoadRows(PropertyPage& page) {
  using namespace modeling;
  Editor& editor = page.editor();
  const Load load = loadOf(editor);
  page.addSection(std::holds_alternative<Pressure>(load.what)          ? tr("Load: pressure")
                  : std::holds_alternative<UniformTraction>(load.what) ? tr("Load: traction")
                                                                       : tr("Load: bump"));
  addName(page);
  if (std::holds_alternative<Pressure>(load.what)) {
    page.addQuantity(tr("&Pressure"), "pressure", Quantity::kStress,
                     reader(editor, &Pressure::pressure), writer(editor, &Pressure::pressure));
    page.addNote(tr("Positive presses into the body."));
    addRegionRows(page, reader(editor, &Pressure::where), writer(editor, &Pressure::where));
  } else if (std::holds_alternative<UniformTraction>(load.what)) {
    page.addVector(tr("&Traction x, y, z"), "traction", Quantity::kStress,
                   reader(editor, &UniformTraction::traction),
                   writer(editor, &UniformTraction::traction));
    addRegionRows(page, reader(editor, &UniformTraction::where),
                  writer(editor, &UniformTraction::where));
  } else {
    page.addVector(tr("&Centre x, y, z"), "centre", Quantity::kLength,
                   reader(editor, &Bump::center), writer(editor, &Bump::center));
    page.addQuantity(tr("&Radius"), "radius", Quantity::kLength, reader(editor, &Bump::radius),
                     writer(editor, &Bump::radius));
    page.addQuantity(tr("Pea&k"), "peak", Quantity::kStress, reader(editor, &Bump::peak),
                     writer(editor, &Bump::peak));
    page.addVector(tr("&Direction x, y, z"), "direction", Quantity::kNumber,
                   reader(editor, &Bump::direction), writer(editor, &Bump::direction));
  }
}

void addTouchRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Touch"));
  addName(page);
  page.addVector(
      tr("&Place x, y, z"), "place", Quantity::kLength, [&editor] { return touchOf(editor).at; },
      [&editor](const Vector3d& at) {
        Touch touch = touchOf(editor);
        touch.at = at;
        return put(editor, touch);
      });
  page.addChoice(
      tr("&Kind"), "kind",
      {tr("Grab: is moved"), tr("Force: is pulled"), tr("Push: a fingertip that slides"),
       tr("Ball: presses and slides"), tr("Pin: is held in place")},
      [&editor] { return static_cast<int>(touchOf(editor).action.index()); },
      [&editor](int kind) {
        Touch touch = touchOf(editor);
        if (kind == static_cast<int>(touch.action.index())) return true;
        touch.action = withKind(touch, kind);
        return put(editor, touch);
      });
  const bool isForce = std::holds_alternative<modeling::TouchForce>(touchOf(editor).action);
  page.addVector(
      isForce ? tr("&Force x, y, z") : tr("&Displacement x, y, z"), "vector",
      isForce ? Quantity::kForce : Quantity::kLength,
      [&editor] { return modeling::vectorOf(touchOf(editor)); },
      [&editor](const Vector3d& vector) {
        Touch touch = touchOf(editor);
        std::visit([&](auto& action) { action.vector = vector; }, touch.action);
        return put(editor, touch);
      });
  if (const QString note = displacementNote(touchOf(editor)); !note.isEmpty()) page.addNote(note);
  if (modeling::frictionOf(touchOf(editor)))
    page.addQuantity(
        tr("Fri&ction"), "friction", Quantity::kNumber,
        [&editor] {
          const Touch touch = touchOf(editor);
          const double* friction = modeling::frictionOf(touch);
          return friction ? *friction : 0.0;
        },
        [&editor](double friction) { return setFriction(editor, friction); });
  addTouchRadius(page);
}

}  // namespace palpa::gui

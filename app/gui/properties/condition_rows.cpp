
#include "app/gui/base/overloaded.h"
#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/properties/pages.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
using modeling::Load;
using modeling::Support;
using modeling::Touch;
using modeling::TouchKind;

/// The selected item; a default one while it is being removed.
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

/// Reads a member of the variant in a load. For a load of another kind another page is made.
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

QString kindText(TouchKind kind) {
  switch (kind) {
    case TouchKind::kGrab:
      return tr("Grab: is moved");
    case TouchKind::kForce:
      return tr("Force: is pulled");
    case TouchKind::kPush:
      return tr("Push: a fingertip that slides");
    case TouchKind::kBall:
      return tr("Ball: presses and slides");
    case TouchKind::kPin:
      return tr("Pin: is fixed in place");
  }
  return {};
}

/// The touch as another kind, with its direction and friction. Between a displacement and a force
/// the length becomes 1; a pin starts where the place is.
Touch withKind(Touch touch, TouchKind kind) {
  const modeling::TouchKindInfo& info = modeling::infoOf(kind);
  if (modeling::infoOf(touch.kind).isForce != info.isForce) touch.vector.stableNormalize();
  if (!info.needsVector) touch.vector.setZero();
  if (!info.presses) touch.friction = 0;
  touch.kind = kind;
  return touch;
}

/// Origin of the displacement; empty for a force.
QString displacementNote(TouchKind kind) {
  switch (kind) {
    case TouchKind::kForce:
      return {};
    case TouchKind::kGrab:
      return tr("From the unloaded shape.");
    case TouchKind::kPin:
      return tr("From where supports and loads alone leave the place.");
    case TouchKind::kPush:
    case TouchKind::kBall:
      return tr("From where the tool first meets the surface.");
  }
  return {};
}

void addTouchRadius(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addCheck(
      tr("Default radius of a &fingertip"), "usualRadius",
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
  page.addSection(std::visit(Overloaded{[](const Pressure&) { return tr("Load: pressure"); },
                                        [](const UniformTraction&) { return tr("Load: traction"); },
                                        [](const Bump&) { return tr("Load: bump"); },
                                        [](const TotalForce&) { return tr("Load: total force"); },
                                        [](const Moment&) { return tr("Load: moment"); },
                                        [](const Gravity&) { return tr("Load: gravity"); }},
                             load.what));
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
  } else if (std::holds_alternative<TotalForce>(load.what)) {
    page.addVector(tr("&Force x, y, z"), "force", Quantity::kForce,
                   reader(editor, &TotalForce::force), writer(editor, &TotalForce::force));
    addRegionRows(page, reader(editor, &TotalForce::where), writer(editor, &TotalForce::where));
  } else if (std::holds_alternative<Moment>(load.what)) {
    page.addVector(tr("&Moment x, y, z (N mm)"), "moment", Quantity::kNumber,
                   reader(editor, &Moment::moment), writer(editor, &Moment::moment));
    addRegionRows(page, reader(editor, &Moment::where), writer(editor, &Moment::where));
  } else if (std::holds_alternative<Gravity>(load.what)) {
    page.addVector(tr("&Acceleration x, y, z (m/s²)"), "acceleration", Quantity::kNumber,
                   reader(editor, &Gravity::accelerationMPerS2),
                   writer(editor, &Gravity::accelerationMPerS2));
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
  QStringList kinds;
  for (const modeling::TouchKindInfo& info : modeling::kTouchKinds) kinds << kindText(info.kind);
  page.addChoice(
      tr("&Kind"), "kind", kinds, [&editor] { return static_cast<int>(touchOf(editor).kind); },
      [&editor](int chosen) {
        const Touch touch = touchOf(editor);
        const auto kind = static_cast<TouchKind>(chosen);
        return kind == touch.kind || put(editor, withKind(touch, kind));
      });
  const modeling::TouchKindInfo& kind = modeling::infoOf(touchOf(editor).kind);
  page.addVector(
      kind.isForce ? tr("&Force x, y, z") : tr("&Displacement x, y, z"), "vector",
      kind.isForce ? Quantity::kForce : Quantity::kLength,
      [&editor] { return touchOf(editor).vector; },
      [&editor](const Vector3d& vector) {
        Touch touch = touchOf(editor);
        touch.vector = vector;
        return put(editor, touch);
      });
  if (const QString note = displacementNote(kind.kind); !note.isEmpty()) page.addNote(note);
  if (kind.presses)
    page.addQuantity(
        tr("Fri&ction"), "friction", Quantity::kNumber,
        [&editor] { return touchOf(editor).friction; },
        [&editor](double friction) {
          Touch touch = touchOf(editor);
          touch.friction = friction;
          return put(editor, touch);
        });
  addTouchRadius(page);
}

}  // namespace palpa::gui

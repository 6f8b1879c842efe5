#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/naming.h"
#include "app/gui/properties/pages.h"

namespace palpa::gui {
namespace {

using Eigen::Vector3d;
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
Touch touchOf(const Editor& editor) {
  return selected(editor, editor.project().touches);
}

bool put(Editor& editor, const Support& support) {
  return editor.perform(modeling::SetSupport{support.name, support});
}
bool put(Editor& editor, const Touch& touch) {
  return editor.perform(modeling::SetTouch{touch.name, touch});
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

void addNameRow(PropertyPage& page) {
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

void addSupportRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Support"));
  addNameRow(page);
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

void addTouchRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Touch"));
  addNameRow(page);
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

#include "app/gui/document/naming.h"

#include "app/gui/base/overloaded.h"
#include "app/gui/base/translate.h"
#include "app/gui/document/named_items.h"

namespace palpa::gui {
namespace {

using modeling::Project;
using Kind = Selection::Kind;

QString takenText(Kind kind, const QString& name) {
  const QString text = kind == Kind::kSupport ? tr("There is already a support named “%1”")
                       : kind == Kind::kLoad  ? tr("There is already a load named “%1”")
                       : kind == Kind::kTouch ? tr("There is already a touch named “%1”")
                                              : tr("There is already a measurement named “%1”");
  return (text + tr("; choose another name.")).arg(name);
}

bool refuseEmpty(Editor& editor, const QString& name) {
  if (!name.isEmpty()) return false;
  Q_EMIT editor.refused(tr("A name needs at least one letter; the old one stays."));
  return true;
}

modeling::Command replacement(const std::string& old, const modeling::Support& with) {
  return modeling::SetSupport{old, with};
}
modeling::Command replacement(const std::string& old, const modeling::Load& with) {
  return modeling::SetLoad{old, with};
}
modeling::Command replacement(const std::string& old, const modeling::Touch& with) {
  return modeling::SetTouch{old, with};
}
modeling::Command replacement(const std::string& old, const modeling::Measurement& with) {
  return modeling::SetMeasurement{old, with};
}

modeling::Command addition(const modeling::Support& one) {
  return modeling::AddSupport{one};
}
modeling::Command addition(const modeling::Load& one) {
  return modeling::AddLoad{one};
}
modeling::Command addition(const modeling::Touch& one) {
  return modeling::AddTouch{one};
}
modeling::Command addition(const modeling::Measurement& one) {
  return modeling::AddMeasurement{one};
}

}  // namespace

bool renameProject(Editor& editor, const QString& name) {
  const QString trimmed = name.trimmed();
  if (refuseEmpty(editor, trimmed)) return false;
  return editor.perform(modeling::RenameProject{trimmed.toStdString()});
}

bool renamePatch(Editor& editor, int patch, const QString& name) {
  const QString trimmed = name.trimmed();
  if (refuseEmpty(editor, trimmed)) return false;
  const std::string old = modeling::patchNames(editor.project().body)[patch];
  if (old == trimmed.toStdString()) return true;
  if (modeling::findPatch(editor.project().body, trimmed.toStdString())) {
    Q_EMIT editor.refused(
        tr("There is already a patch named “%1”; choose another name.").arg(trimmed));
    return false;
  }
  return editor.perform(modeling::RenamePatch{old, trimmed.toStdString()});
}

bool renameNamed(Editor& editor, const Selection::Named& which, const QString& name) {
  const QString trimmed = name.trimmed();
  if (refuseEmpty(editor, trimmed)) return false;
  const std::string to = trimmed.toStdString();
  if (to == which.name) return true;
  if (hasNamed(editor.project(), {which.kind, to})) {
    Q_EMIT editor.refused(takenText(which.kind, trimmed));
    return false;
  }
  const bool wasSelected = editor.selection().named == which;
  const Selection::Named old = which;  // `which` may refer to the selection
  const bool done = withList(editor.project(), old.kind, [&](const auto& list) {
    const auto* found = findNamed(list, old.name);
    if (!found) return false;
    auto renamed = *found;
    renamed.name = to;
    return editor.perform(replacement(old.name, renamed));
  });
  if (done && wasSelected) editor.select(Selection::of(old.kind, to));
  return done;
}

void duplicate(Editor& editor, const Selection::Named& which) {
  const Selection::Named original = which;
  std::string name;
  for (int i = 2; name.empty() || hasNamed(editor.project(), {original.kind, name}); ++i)
    name = original.name + " " + std::to_string(i);
  const bool done = withList(editor.project(), original.kind, [&](const auto& list) {
    const auto* found = findNamed(list, original.name);
    if (!found) return false;
    auto copy = *found;
    copy.name = name;
    return editor.perform(addition(copy));
  });
  if (done) editor.select(Selection::of(original.kind, name));
}

void deleteSelected(Editor& editor) {
  const Selection& selection = editor.selection();
  if (!selection.points.empty()) {
    Q_EMIT editor.refused(
        tr("Control points cannot be deleted one by one, they form nets; remove a knot to get a "
           "coarser net."));
  } else if (!selection.patches.empty()) {
    Q_EMIT editor.refused(tr("Patches cannot be deleted, the body would no longer be closed."));
  } else if (!selection.edges.empty()) {
    Q_EMIT editor.refused(tr("Edges cannot be deleted; make them smooth to blend the patches."));
  } else if (!selection.named) {
    Q_EMIT editor.refused(
        tr("Nothing is selected; select a support, load, touch or measurement to "
           "delete."));
  } else {
    const Selection::Named named = *selection.named;
    if (named.kind == Kind::kSupport) editor.perform(modeling::RemoveSupport{named.name});
    if (named.kind == Kind::kLoad) editor.perform(modeling::RemoveLoad{named.name});
    if (named.kind == Kind::kTouch) editor.perform(modeling::RemoveTouch{named.name});
    if (named.kind == Kind::kMeasurement) editor.perform(modeling::RemoveMeasurement{named.name});
  }
}

QString bodyTitle(const Project& project) {
  if (!std::holds_alternative<modeling::Solid>(project.body)) return tr("Mesh body");
  if (!project.primitive) return tr("Solid");
  return std::visit(Overloaded{
                        [](const modeling::BoxShape&) { return tr("Box"); },
                        [](const modeling::SphereShape&) { return tr("Sphere"); },
                        [](const modeling::EllipsoidShape&) { return tr("Ellipsoid"); },
                        [](const modeling::CylinderShape&) { return tr("Cylinder"); },
                        [](const modeling::ConeShape&) { return tr("Cone"); },
                        [](const modeling::CapsuleShape&) { return tr("Capsule"); },
                        [](const modeling::TorusShape&) { return tr("Torus"); },
                        [](const modeling::RevolveShape&) { return tr("Revolved profile"); },
                        [](const modeling::ExtrudeShape&) { return tr("Extruded profile"); },
                        [](const modeling::LoftShape&) { return tr("Lofted sections"); },
                    },
                    project.primitive->shape);
}

}  // namespace palpa::gui

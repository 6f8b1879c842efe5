#include "app/gui/properties/pages.h"

#include "app/gui/document/editor.h"
#include "app/gui/document/named_items.h"

namespace palpa::gui {
namespace {

using modeling::Project;

QString measurementKey(const Project& project, const std::string& name) {
  const auto* measurement = findNamed(project.measurements, name);
  return measurement ? QString("measurement %1").arg(static_cast<int>(measurement->kind))
                     : QString("measurement");
}

QString namedKey(const Project& project, const Selection::Named& named) {
  switch (named.kind) {
    case Selection::Kind::kSupport: {
      const auto* support = findNamed(project.supports, named.name);
      return support ? "support " + regionKey(support->where) : QString("support");
    }
    case Selection::Kind::kLoad: {
      const auto* load = findNamed(project.loads, named.name);
      if (!load) return "load";
      const modeling::Region* region = modeling::regionOf(*load);
      return QString("load %1 %2 ")
                 .arg(load->what.index())
                 .arg(project.material.densityKgPerM3.has_value()) +
             (region ? regionKey(*region) : QString());
    }
    case Selection::Kind::kMeasurement:
      return measurementKey(project, named.name);
    case Selection::Kind::kTouch:
      break;
  }
  const auto* touch = findNamed(project.touches, named.name);
  return touch ? QString("touch %1 %2")
                     .arg(static_cast<int>(touch->kind))
                     .arg(touch->radius.has_value())
               : QString("touch");
}

}  // namespace

QString pageKey(const Editor& editor) {
  const Selection& selection = editor.selection();
  const Project& project = editor.project();
  if (!selection.points.empty()) return selection.points.size() == 1 ? "point" : "points";
  if (!selection.patches.empty())
    return QString(selection.patches.size() == 1 ? "patch" : "patches") +
           (editor.solid() ? "" : " of mesh");
  if (!selection.edges.empty()) return selection.edges.size() == 1 ? "edge" : "edges";
  if (selection.named) return namedKey(project, *selection.named);
  QString key = QString("project %1").arg(project.body.index());
  if (project.primitive) key += QString(" %1").arg(project.primitive->shape.index());
  if (project.mesh.splineDensity != 1) key += " denser";
  for (const auto& [patch, factor] : project.mesh.patchFactors)
    key += "|" + QString::fromStdString(patch);
  return key;
}

PropertyPage* makePage(const Workspace& workspace) {
  auto* page = new PropertyPage(workspace);
  const Selection& selection = workspace.editor.selection();
  if (!selection.points.empty())
    addPointRows(*page);
  else if (!selection.patches.empty())
    addPatchRows(*page);
  else if (!selection.edges.empty())
    addEdgeRows(*page);
  else if (!selection.named)
    addProjectRows(*page);
  else if (selection.named->kind == Selection::Kind::kSupport)
    addSupportRows(*page);
  else if (selection.named->kind == Selection::Kind::kLoad)
    addLoadRows(*page);
  else if (selection.named->kind == Selection::Kind::kTouch)
    addTouchRows(*page);
  else
    addMeasurementRows(*page);
  return page;
}

}  // namespace palpa::gui

#include "app/gui/docks/model_lines.h"

#include <array>

#include "app/gui/base/translate.h"
#include "app/gui/document/load_kinds.h"
#include "app/gui/document/measurement_words.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/naming.h"

namespace palpa::gui {
namespace {

QString fromUtf8(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

}  // namespace

ModelLine lineOf(ModelRow row, const Editor& editor) {
  const modeling::Project& project = editor.project();
  switch (row) {
    case ModelRow::kProject:
      return {QString::fromStdString(project.name), {}, "model", tr("The project")};
    case ModelRow::kBody:
      return {bodyTitle(project), {}, "solid", tr("The body")};
    case ModelRow::kPatches:
      return {editor.solid() ? tr("Patches") : tr("Faces"), {}, "patch", {}};
    case ModelRow::kEdges:
      return {tr("Edges"), {}, "edge", {}};
    case ModelRow::kSupports:
      return {tr("Supports"), {}, "paint-support", tr("Supported parts of the surface")};
    case ModelRow::kLoads:
      return {tr("Loads"),
              {},
              "place-load",
              tr("Forces, moments and pressures on the surface, and gravity")};
    case ModelRow::kTouches:
      return {tr("Touches"),
              {},
              "place-touch",
              tr("Touches stored in the project; Simulate plays them")};
    case ModelRow::kMeasurements:
      return {
          tr("Measurements"), {}, "measure", tr("Dimensions of the body; they follow its shape")};
    case ModelRow::kMaterial:
      return {tr("Material"), QString::fromStdString(project.material.name), "material",
              QString::fromStdString(project.material.name)};
    case ModelRow::kMesh:
      return {tr("Mesh"),
              shown(project.mesh.edgeLength, Quantity::kLength, editor.settings().units(), 4),
              "wire", tr("Length of the mesh's edges")};
    default:
      return {};
  }
}

ModelLines patchLines(const Editor& editor) {
  ModelLines lines;
  if (const modeling::Solid* solid = editor.solid()) {
    for (const modeling::Patch& patch : solid->patches())
      lines.push_back(
          {QString::fromStdString(patch.name),
           QStringLiteral("%1 × %2").arg(patch.net.size()).arg(patch.net.front().size()), "patch",
           tr("Patch of degree %1 × %2").arg(patch.degree[0]).arg(patch.degree[1])});
  } else {
    for (const std::string& name : modeling::patchNames(editor.project().body))
      lines.push_back({QString::fromStdString(name), {}, "patch", tr("Face of the mesh body")});
  }
  return lines;
}

ModelLines edgeLines(const Editor& editor) {
  ModelLines lines;
  const modeling::Solid* solid = editor.solid();
  if (!solid) return lines;
  for (const modeling::SolidEdge& edge : solid->edges()) {
    std::array<QString, 2> names, sides;
    for (int use = 0; use < 2; ++use) {
      names[use] = QString::fromStdString(solid->patches()[edge.uses[use].patch].name);
      sides[use] = fromUtf8(modeling::sideName(edge.uses[use].side));
    }
    lines.push_back(
        {names[0] + " – " + names[1], edge.smooth ? tr("smooth") : tr("sharp"),
         edge.smooth ? "smooth-edge" : "edge",
         tr("Side %1 of %2, side %3 of %4").arg(sides[0], names[0], sides[1], names[1])});
  }
  return lines;
}

ModelLines supportLines(const Editor& editor) {
  ModelLines lines;
  for (const modeling::Support& each : editor.project().supports) {
    const bool isFixed = each.kind == modeling::Support::Kind::kFixed;
    lines.push_back({QString::fromStdString(each.name), isFixed ? tr("fixed") : tr("roller"),
                     "paint-support",
                     isFixed ? tr("Fixed in all directions") : tr("Slides along the surface")});
  }
  return lines;
}

ModelLines loadLines(const Editor& editor) {
  ModelLines lines;
  const ShownUnits units = editor.settings().units();
  for (const modeling::Load& each : editor.project().loads)
    lines.push_back({QString::fromStdString(each.name), strengthText(each, units),
                     infoOf(loadKindOf(each)).icon, loadText(each, units)});
  return lines;
}

ModelLines touchLines(const Editor& editor) {
  ModelLines lines;
  for (const modeling::Touch& each : editor.project().touches)
    lines.push_back({QString::fromStdString(each.name),
                     tr(modeling::infoOf(each.kind).name),
                     "place-touch",
                     {}});
  return lines;
}

ModelLines measurementLines(Editor& editor) {
  ModelLines lines;
  const auto& list = editor.project().measurements;
  if (list.empty()) return lines;
  const auto& results = editor.measurements().results();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Measurements::Result& result = results[i];
    lines.push_back({QString::fromStdString(list[i].name),
                     result.value
                         ? dimensionText(list[i].kind, *result.value, editor.settings().units())
                         : tr("gone"),
                     result.value ? "measure" : "warning",
                     result.value ? kindText(list[i].kind) : result.problem});
  }
  return lines;
}

}  // namespace palpa::gui

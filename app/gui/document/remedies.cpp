#include "app/gui/document/remedies.h"

#include <algorithm>

#include "app/gui/base/translate.h"
#include "app/gui/document/named_items.h"
#include "app/gui/document/own_materials.h"
#include "modeling/project/proposed_support.h"

namespace palpa::gui {
namespace {

QString quoted(const std::string& name) {
  return "“" + QString::fromStdString(name) + "”";
}

/// One of two contradicting supports keeps the place.
Remedy resolving(Editor& editor, const app::SupportConflict& conflict, bool firstKeeps) {
  const modeling::TakeOverlap command = app::resolution(conflict, firstKeeps, editor.project());
  const QString gap = shown(command.gap, Quantity::kLength, editor.settings().units(), 3);
  return {(conflict.overlaps ? tr("Give it to %1") : tr("Shorten %1"))
              .arg(quoted(conflict.overlaps ? command.name : command.from)),
          tr("%1 then ends %2 before %3: the surface between both is free, as their "
             "displacements differ")
              .arg(quoted(command.from), gap, quoted(command.name)),
          [&editor, command] { editor.perform(command); }};
}

Remedy proposingASupport(Editor& editor) {
  return {tr("Propose a support"),
          tr("Add a fixed support on the largest flat face, or on the lowest tenth of a body "
             "without flat faces"),
          [&editor] {
            modeling::Support base = modeling::proposeSupport(editor.project().body).support;
            const auto& supports = editor.project().supports;
            if (findNamed(supports, base.name)) base.name = freeName(base.name, supports);
            if (editor.perform(modeling::AddSupport{base}))
              editor.select(Selection::of(Selection::Kind::kSupport, base.name));
          }};
}

/// The mesh that was found to fit into memory and to bound a body.
Remedy meshing(Editor& editor, const modeling::MeshSettings& mesh) {
  const ShownUnits& units = editor.settings().units();
  const modeling::MeshSettings& present = editor.project().mesh;
  QString text;
  if (mesh.edgeLength != present.edgeLength)
    text = tr("Use an edge length of %1").arg(shown(mesh.edgeLength, Quantity::kLength, units, 3));
  else if (mesh.elementLength != present.elementLength)
    text = tr("Use elements of %1").arg(shown(*mesh.elementLength, Quantity::kLength, units, 3));
  else
    text = tr("Use an accuracy of %1 %").arg(100 * mesh.accuracy, 0, 'g', 2);
  return {text, tr("This mesh was tried: its model fits into memory"),
          [&editor, mesh] { editor.perform(modeling::SetMesh{mesh}); }};
}

/// Removes the support or load whose region is empty.
std::vector<Remedy> removing(Editor& editor, const std::string& emptyRegion) {
  const modeling::Project& project = editor.project();
  const auto regions = modeling::meshRegions(project);
  const auto found = std::find_if(regions.begin(), regions.end(),
                                  [&](const auto& region) { return region.name == emptyRegion; });
  if (found == regions.end()) return {};
  auto index = static_cast<std::size_t>(found - regions.begin());
  const auto remedy = [&](const std::string& name, auto command) {
    return Remedy{tr("Remove %1").arg(quoted(name)), tr("It has no part of the surface"),
                  [&editor, command] { editor.perform(command); }};
  };
  if (index < project.supports.size()) {
    const std::string& name = project.supports[index].name;
    return {remedy(name, modeling::RemoveSupport{name})};
  }
  index -= project.supports.size();
  for (const modeling::Load& load : project.loads)
    if (modeling::regionOf(load) && index-- == 0)
      return {remedy(load.name, modeling::RemoveLoad{load.name})};
  return {};
}

}  // namespace

Remedy usualDensity(Editor& editor) {
  const modeling::LibraryMaterial& similar = similarWithDensity(editor.project().material);
  const double density = *similar.material.densityKgPerM3;
  return {tr("Use %1").arg(shown(density, Quantity::kDensity, editor.settings().units(), 4)),
          tr("The density of %1, the material of the library that is nearest in stiffness")
              .arg(quoted(similar.material.name)),
          [&editor, density] {
            modeling::Material material = editor.project().material;
            material.densityKgPerM3 = density;
            editor.perform(modeling::SetMaterial{material});
          }};
}

std::vector<Remedy> remediesOf(Editor& editor) {
  const app::RebuildStatus status = editor.rebuildStatus();
  if (status.state != app::RebuildStatus::State::kFailed) return {};
  if (status.reason.conflict)
    return {resolving(editor, *status.reason.conflict, false),
            resolving(editor, *status.reason.conflict, true)};
  if (!status.reason.emptyRegion.empty()) return removing(editor, status.reason.emptyRegion);
  if (status.reason.isFree) return {proposingASupport(editor)};
  if (status.reason.needsDensity) return {usualDensity(editor)};
  std::vector<Remedy> remedies;
  if (status.reason.mesh) remedies.push_back(meshing(editor, *status.reason.mesh));
  const bool isGeometry = !status.stages.empty() && status.stages.back().phase == Phase::kCheck;
  if (isGeometry && editor.session().document().canUndo())
    remedies.push_back({tr("Undo the last step"),
                        QString::fromStdString(editor.session().document().undoLabel()),
                        [&editor] { editor.undo(); }});
  return remedies;
}

}  // namespace palpa::gui

#include "modeling/exchange/import.h"

#include "modeling/error.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_reader.h"

namespace palpa::modeling {
namespace {

ImportedBody importedFrom(const ChosenMesh& chosen, const ImportPlacement& placement,
                          const std::filesystem::path& path) {
  ImportedBody imported{placed(chosen.body, 1.0, placement.up), {}, 0.0, {}};
  if (chosen.found.bodies.size() > 1) {
    imported.name = projectName(chosen.found.bodies[chosen.index], path);
    imported.notes.push_back(chosenNote(chosen.found, chosen.index));
  }
  return imported;
}

ImportedBody importMesh(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  options.validate();
  const ImportPlacement& placement = options.placement;
  return importedFrom(chooseMesh(path, {placement.factor(1.0), options.solid, placement.up}, job),
                      placement, path);
}

void importMeshBodies(const std::filesystem::path& path, const ImportOptions& options,
                      const TakeBody& take, const Job& job) {
  options.validate();
  const ImportPlacement& placement = options.placement;
  readMeshBodies(
      path, {placement.factor(1.0), {}, placement.up},
      [&](std::size_t index, const std::optional<ChosenMesh>& chosen, const std::string& problem) {
        BodyOutcome outcome{std::nullopt, problem};
        if (chosen) outcome.imported = importedFrom(*chosen, placement, path);
        take(index, std::move(outcome));
      },
      job);
}

void addSizeWarning(ImportedBody& imported) {
  const auto [low, high] = boundingBox(imported.body);
  const std::string warning = sizeWarning(high - low);
  if (!warning.empty()) imported.notes.push_back(warning);
}

}  // namespace

ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  ImportedBody imported = isCad(infoOf(requireFormat(path, isImportable)))
                              ? importCad(path, options, job)
                              : importMesh(path, options, job);
  addSizeWarning(imported);
  return imported;
}

void importBodies(const std::filesystem::path& path, std::size_t count,
                  const ImportOptions& options, const TakeBody& take, const Job& job) {
  std::size_t done = 0;
  const auto takeOne = [&](std::size_t index, BodyOutcome outcome) {
    if (index >= count) return;
    if (outcome.imported) addSizeWarning(*outcome.imported);
    take(index, std::move(outcome));
    ++done;
  };
  if (isCad(infoOf(requireFormat(path, isImportable))))
    importCadBodies(path, count, options, takeOne, job);
  else
    importMeshBodies(path, options, takeOne, job);
  for (; done < count; ++done)
    take(done, {std::nullopt, path.string() + ": has only " + std::to_string(done) +
                                  " solids now; list them again"});
}

}  // namespace palpa::modeling

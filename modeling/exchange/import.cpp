#include "modeling/exchange/import.h"

#include "modeling/error.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_reader.h"

namespace palpa::modeling {
namespace {

ImportedBody importMesh(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  options.validate();
  const ImportPlacement& placement = options.placement;
  const ChosenMesh chosen =
      chooseMesh(path, {placement.factor(1.0), options.solid, placement.up}, job);
  ImportedBody imported{placed(chosen.body, 1.0, placement.up), {}, 0.0, {}};
  if (chosen.found.bodies.size() > 1) {
    imported.name = projectName(chosen.found.bodies[chosen.index], path);
    imported.notes.push_back(chosenNote(chosen.found, chosen.index));
  }
  return imported;
}

}  // namespace

ImportedBody importBody(const std::filesystem::path& path, const ImportOptions& options,
                        const Job& job) {
  ImportedBody imported = isCad(infoOf(requireFormat(path, isImportable)))
                              ? importCad(path, options, job)
                              : importMesh(path, options, job);
  const auto [low, high] = boundingBox(imported.body);
  const std::string warning = sizeWarning(high - low);
  if (!warning.empty()) imported.notes.push_back(warning);
  return imported;
}

}  // namespace palpa::modeling

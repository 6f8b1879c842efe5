#include "app/core/session/import_project.h"

#include "app/core/session/new_project.h"
#include "base/text.h"
#include "modeling/body/closed_surfaces.h"
#include "modeling/exchange/import.h"

namespace palpa::app {
namespace {

constexpr double kCavityPoissonRatio = 0.45;

}  // namespace

ImportedProject importProject(const std::filesystem::path& path,
                              const modeling::ImportOptions& options, const Job& job) {
  return makeImportedProject(modeling::importBody(path, options, job), path, options);
}

ImportedProject makeImportedProject(modeling::ImportedBody imported,
                                    const std::filesystem::path& path,
                                    const modeling::ImportOptions& options) {
  const std::string name = imported.name.empty() ? path.stem().string() : imported.name;
  ImportedProject result{makeProject(std::move(imported.body), name),
                         imported.deviation,
                         std::move(imported.notes),
                         {}};
  modeling::Project& project = result.project;
  result.held = modeling::proposeSupport(project.body);
  project.supports = {result.held.support};
  if (options.edgeLength > 0) project.mesh.edgeLength = options.edgeLength;
  if (modeling::closedSurfaceCount(project.body) > 1) {
    result.notes.push_back(
        "The body has a closed cavity, so the Poisson's ratio of its material is " +
        numberText(kCavityPoissonRatio) + " instead of " +
        numberText(project.material.poissonRatio) +
        ": a cavity in nearly incompressible material cannot be computed.");
    project.material.poissonRatio = kCavityPoissonRatio;
  }
  return result;
}

}  // namespace palpa::app

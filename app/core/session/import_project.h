#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/job.h"
#include "modeling/exchange/cad_import.h"
#include "modeling/project/project.h"
#include "modeling/project/proposed_support.h"

namespace palpa::app {

/// A project made from a file of another program.
struct ImportedProject {
  modeling::Project project;
  double deviation = 0.0;          ///< mm, see modeling::ImportedBody
  std::vector<std::string> notes;  ///< sentences for the user, see modeling::ImportedBody
  modeling::ProposedSupport held;  ///< the support of the project
};

/// importProject() with a body that was read already from the file `path`.
ImportedProject makeImportedProject(modeling::ImportedBody imported,
                                    const std::filesystem::path& path,
                                    const modeling::ImportOptions& options);

/// A project with the body of a CAD or mesh file that can be touched at once: named after the file
/// (or after the body, if the file has several), with the default material, the edge length of the
/// options or a suitable one, and the support of modeling::proposeSupport(). A body with a closed
/// cavity gets a smaller Poisson's ratio than the default material, because the solver refuses
/// cavities in nearly incompressible material. Throws as modeling::importBody().
ImportedProject importProject(const std::filesystem::path& path,
                              const modeling::ImportOptions& options = {}, const Job& job = {});

}  // namespace palpa::app

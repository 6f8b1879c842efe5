#pragma once

#include <filesystem>
#include <string>

#include "base/job.h"
#include "modeling/body/body.h"

namespace palpa::modeling {

/// Writes a solid to a CAD file in the format of the file's ending: one face with natural bounds
/// per patch, shared edges and vertices, lengths in mm, patch names as the names of the faces
/// (docs/exchange.md says where each format keeps them). `name` is the name of the part; empty for
/// "palpa". importCad() gives the same solid back.
///
/// The file is written beside the target and renamed: an old file stays until the new one is
/// complete. Smooth edges are not marked as such in the file. Exports and imports of several
/// threads run one after the other. Cancelled between stages.
///
/// @throws ModelingError: unknown ending; a mesh body (the message names the formats for it); kind
///         io when the file cannot be written. Cancelled.
void exportCad(const Body& body, const std::filesystem::path& path, const std::string& name = "",
               const Job& job = {});

}  // namespace palpa::modeling

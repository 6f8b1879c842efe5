#pragma once

#include <filesystem>
#include <string>

#include "base/job.h"
#include "modeling/body/body.h"

namespace palpa::modeling {

/// Writes a solid to a CAD file in the format of the file's ending: one face with natural bounds
/// per patch, shared edges and vertices, lengths in mm, patch names as names of the faces
/// (docs/exchange.md lists their place in each format). `name` is the name of the part; if it is
/// empty, the part is named "palpa". importCad() reads the same solid back.
///
/// The file is written beside the target and renamed: an old file remains until the new one is
/// complete. The file does not store which edges are smooth. Exports and imports of several threads
/// run one after the other. A stopped job is noticed between stages.
///
/// Throws ModelingError if the ending is unknown, if the body is a mesh body (the message names the
/// formats for it), or (kind io) if the file cannot be written; Cancelled.
void exportCad(const Body& body, const std::filesystem::path& path, const std::string& name = "",
               const Job& job = {});

}  // namespace palpa::modeling

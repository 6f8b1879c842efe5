#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "modeling/exchange/import.h"
#include "modeling/project/project.h"
#include "modeling/project/proposed_support.h"

// Bodies in files of any kind: projects, CAD files, triangle meshes.
namespace palpa::cli {

/// A project and notes on its origin.
struct ReadBody {
  modeling::Project project;
  double deviation = 0.0;  ///< mm, from the file's surfaces
  std::vector<std::string> notes;
  std::optional<modeling::ProposedSupport> held;  ///< of an imported body
};

/// Reads a project, or makes one from an imported body, with the name of the file.
ReadBody readBody(const std::string& path, const modeling::ImportOptions& options, const Job& job);

/// Writes a project, its solid as CAD file or its surface mesh, depending on the file's ending. The
/// triangles of a mesh body are written as they are unless `remesh` asks for the edge
/// length of the project.
void writeBody(const modeling::Project& project, const std::string& path, bool remesh,
               const Job& job);

/// Kind and size of the body, deviation and notes.
Json toJson(const ReadBody& read);
std::string toText(const ReadBody& read);

/// Name of the support, the place it holds in words, and the names of the held faces.
Json toJson(const modeling::ProposedSupport& proposed);

}  // namespace palpa::cli

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "modeling/exchange/import.h"
#include "modeling/project/project.h"

// Bodies in files of any kind: projects, CAD files, triangle meshes.
namespace palpa::cli {

/// Stop token and progress line of a command, for long operations of modeling/.
Job modelingJob(const Context& context);

/// A project, and what is to be said about where it came from.
struct ReadBody {
  modeling::Project project;
  double deviation = 0.0;  ///< mm, from the file's surfaces
  std::vector<std::string> notes;
};

/// Reads a project (.json) as it is, or makes one around an imported body, named like the file.
ReadBody readBody(const std::string& path, const modeling::ImportOptions& options, const Job& job);

inline constexpr const char* kWritableEndings =
    ".json, .step, .stp, .iges, .igs, .brep, .stl, .obj or .ply";

/// Throws OutputError unless the ending is one of kWritableEndings. To be called before the work.
void requireWritable(const std::string& path);

/// Writes a project's body: .json the project, CAD files the solid, .stl, .obj and .ply its surface
/// mesh. The triangles of a mesh body are written as they are unless `remesh` asks for the edge
/// length of the project.
void writeBody(const modeling::Project& project, const std::string& path, bool remesh,
               const Job& job);

/// Kind and size of the body, deviation and notes.
Json toJson(const ReadBody& read);
std::string toText(const ReadBody& read);

}  // namespace palpa::cli

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/core/session/import_project.h"
#include "modeling/exchange/file_bodies.h"

namespace palpa::app {

/// A solid of a file, imported into a project file.
struct SavedBody {
  std::filesystem::path file;
  std::string problem;  ///< why it was not written; empty if it was
};

/// True if `target` contains {number} or {name}, which projectFiles() replaces.
bool isFilePattern(const std::string& target);

/// Project files for the bodies of a file, all different. `target` is a pattern with {number} or
/// {name}, or a folder for {name}.json. Characters that file names should not have become '_'.
std::vector<std::filesystem::path> projectFiles(const modeling::FileBodies& found,
                                                const std::string& target);

/// Imports every body of `found`, the list of the file `path`, which is read once more for all of
/// them, and writes a project file for each; makes the folders. `options.solid` has no meaning. A
/// body that cannot be imported does not stop the others. Throws FileError if a folder cannot be
/// made, ModelingError if the file cannot be read any more; Cancelled, then the files written so
/// far remain.
std::vector<SavedBody> importAll(const std::filesystem::path& path,
                                 const modeling::FileBodies& found, modeling::ImportOptions options,
                                 const std::vector<std::filesystem::path>& files,
                                 const Job& job = {});

}  // namespace palpa::app

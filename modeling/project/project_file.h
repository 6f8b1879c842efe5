#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "modeling/project/project.h"

// Reading and writing project files (docs/project-file.md; resources/project.schema.json).
namespace palpa::modeling {

inline constexpr int kProjectVersion = 3;
inline constexpr std::size_t kMaxProjectFile = 64UL << 20;   // bytes
inline constexpr std::size_t kMaxProjectValues = 2'000'000;  // numbers, strings, lists, …
inline constexpr int kDeepestNesting = 32;

/// Reads and checks a project. Throws ModelingError that begins with the file's name and the JSON
/// path: `ball.json: supports[0].kind: found "glued", expected one of "fixed", "roller"`. Hostile
/// files (huge, deeply nested, truncated, repeated keys, numbers beyond double) are refused before
/// they cost much time or memory.
Project readProject(const std::filesystem::path& path);

/// The same for text in memory; messages begin with sourceName.
Project parseProject(std::string_view text, const std::string& sourceName);

/// The text of a project file: fixed key order, one control point per line, numbers with the fewest
/// digits that give the same bits. toJson(parseProject(toJson(p))) == toJson(p), byte for byte.
std::string toJson(const Project& project);

/// toJson() after checkProject() and after parsing the text again, so that the saved file can be
/// opened within all limits. Cost: as loading. Throws ModelingError that begins with `name`.
std::string checkedText(const Project& project, const std::string& name);

/// Saves checkedText() with writeAtomically() and keeps the old file as backupPath(). Throws
/// ModelingError and leaves the old file unchanged if this fails.
void writeProject(const Project& project, const std::filesystem::path& path);

}  // namespace palpa::modeling

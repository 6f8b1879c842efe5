#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "modeling/project/project.h"

// Reading and writing project files (docs/project-file.md; resources/project.schema.json).
namespace palpa::modeling {

inline constexpr int kProjectVersion = 2;
inline constexpr std::size_t kMaxProjectFile = 64UL << 20;   // bytes
inline constexpr std::size_t kMaxProjectValues = 2'000'000;  // numbers, strings, lists, …
inline constexpr int kDeepestNesting = 32;

/// Reads and checks a project. Every error is a ModelingError whose message begins with the file's
/// name and the JSON path: `ball.json: supports[0].kind: found "glued", expected one of "fixed",
/// "roller"`. Hostile files (huge, deeply nested, truncated, repeated keys, numbers beyond double)
/// are refused before they cost much time or memory.
Project readProject(const std::filesystem::path& path);

/// The same for text in memory; sourceName stands in front of messages.
Project parseProject(std::string_view text, const std::string& sourceName);

/// The text of a project file: fixed key order, numbers as short as they read back exactly, one
/// control point per line. toJson(parseProject(toJson(p))) == toJson(p), byte for byte.
std::string toJson(const Project& project);

/// toJson() after checkProject() and after reading the text back: what is saved can be opened
/// again, within all limits on size. Costs as much as loading. @throws ModelingError with `name` in
/// front
std::string checkedText(const Project& project, const std::string& name);

/// Saves checkedText() with writeAtomically(); the old file stays as backupPath(). On failure
/// (ModelingError) the old file is untouched.
void writeProject(const Project& project, const std::filesystem::path& path);

}  // namespace palpa::modeling

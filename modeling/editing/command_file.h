#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "modeling/editing/command.h"

// Commands as JSON (docs/editing.md; resources/commands.schema.json).
namespace palpa::modeling {

/// Reads `{"commands": […]}` or the list alone. Throws ModelingError that begins with the source
/// and the path: `edit.json: commands[3].by_mm: found "x", expected a list`.
std::vector<Command> parseCommands(std::string_view text, const std::string& sourceName);

/// The same from a file, with the limits of project files.
std::vector<Command> readCommands(const std::filesystem::path& path);

/// One line of JSON. Reading it gives the same command with the same bits of all numbers.
std::string toJson(const Command& command);

/// The text of a file for parseCommands(), one command per line.
std::string toJson(const std::vector<Command>& commands);

/// A selection as the value of the key `points`.
std::string toJson(const PointSelection& selection);

}  // namespace palpa::modeling

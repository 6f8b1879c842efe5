#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// The manual page of the program, for man(1): what --help says of the program and all of its
/// commands.
std::string manualPage(const CLI::App& app);

/// Completion for bash: commands, the options of each, and files.
std::string bashCompletion(const CLI::App& app);

}  // namespace palpa::cli

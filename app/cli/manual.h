#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// Manual page for man(1): the --help texts of the program and of all commands.
std::string manualPage(const CLI::App& app);

/// Completion for bash: commands, the options of each, and files.
std::string bashCompletion(const CLI::App& app);

}  // namespace palpa::cli

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// What is wrong with a command line that CLI11 refused, in one line for people: with the nearest
/// command or option where one was misspelt, and where to read on.
std::string usageMessage(const CLI::ParseError& error, const CLI::App& app, int argc,
                         const char* const* argv);

}  // namespace palpa::cli

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// What --help prints: lines that fit a terminal of 80 columns, in the words of the documentation.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace palpa::cli

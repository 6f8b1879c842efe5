#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace palpa::cli {

/// Format of --help: lines of at most 80 columns.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat();
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace palpa::cli

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/cli/command.h"

namespace palpa::cli {

/// The option -o, --output FILE of a command.
class OutputOption {
 public:
  /// Adds the option and returns it, for commands that require it.
  CLI::Option* declare(CLI::App& options, const std::string& help);

  bool isGiven() const { return !path_.empty(); }
  const std::string& path() const { return path_; }
  /// Ending of the file's name, as ".csv"; empty without one.
  std::string ending() const;

  /// Adds the file, which was written, to a report.
  void addTo(Json& report, std::string& text) const;

 private:
  std::string path_;
};

}  // namespace palpa::cli

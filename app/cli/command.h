#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "app/cli/progress_line.h"
#include "base/job.h"

namespace palpa::cli {

/// JSON whose keys keep their order.
using Json = nlohmann::ordered_json;

/// Options every subcommand has.
struct CommonOptions {
  bool json = false;   ///< one JSON object on standard output instead of text
  bool quiet = false;  ///< no text and no progress; errors are still written
  int threads = 0;     ///< 0: all cores
};

/// Options and services for a running command.
struct Context {
  CommonOptions options;
  std::stop_token stop;
  ProgressLine& progress;

  /// Stop token, number of threads and progress line for long operations.
  Job job() const;

  /// Writes `report` as JSON, or `text`, or nothing, depending on the options.
  void print(const Json& report, const std::string& text) const;
};

/// One subcommand: declares its options, then runs once if the user chose it. Errors are
/// exceptions; `errors.h` turns them into exit codes.
class Command {
 public:
  virtual ~Command() = default;

  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;  ///< one line, for the list of subcommands
  virtual std::string example() const = 0;  ///< shown by --help
  virtual void declare(CLI::App& options) = 0;
  virtual void run(const Context& context) = 0;
};

/// All subcommands, in the order in which the help lists them.
std::vector<std::unique_ptr<Command>> allCommands();

}  // namespace palpa::cli

#pragma once

#include <stdexcept>
#include <string>

#include "app/cli/exit_code.h"

namespace palpa::cli {

/// The command line is wrong in a way CLI11 cannot see (a number out of range, a pair of options).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file the command was asked to write cannot be written.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command has written its report, which says what is wrong.
class ReportedFailure : public std::runtime_error {
 public:
  explicit ReportedFailure(const std::string& message, ExitCode code = kBadInput)
      : std::runtime_error(message), code_(code) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// What remains of an exception at the end of the program: one line for people, a code for the
/// shell.
struct Failure {
  ExitCode code = kInternalError;
  std::string kind;  ///< the code's name in JSON: "usage", "bad_input", …
  std::string message;
  bool isReported = false;  ///< standard output has it already
};

/// Translates the exception being handled. To be called inside a catch block.
Failure currentFailure();

}  // namespace palpa::cli

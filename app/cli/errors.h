#pragma once

#include <stdexcept>
#include <string>

#include "app/cli/exit_code.h"

namespace palpa::cli {

/// An error of the command line that CLI11 cannot detect (a number out of range, a pair of
/// options).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Standard output, a pipe or a folder cannot be written; files throw FileError.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command has written its report, which states the error.
class ReportedFailure : public std::runtime_error {
 public:
  explicit ReportedFailure(const std::string& message, ExitCode code = kBadInput)
      : std::runtime_error(message), code_(code) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// An exception at the end of the program: one line for the user, a code for the shell.
struct Failure {
  ExitCode code = kInternalError;
  std::string kind;  ///< the code's name in JSON: "usage", "bad_input", …
  std::string message;
  bool isReported = false;  ///< standard output has it already
};

/// Translates the current exception. Call it inside a catch block.
Failure currentFailure();

/// Writes to standard error that an option, or a value of an option, has a new name.
void noteFormerName(const std::string& former, const std::string& present);

}  // namespace palpa::cli

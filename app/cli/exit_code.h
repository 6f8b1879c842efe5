#pragma once

namespace palpa::cli {

/// Exit codes of palpa-cli; documented in docs/guide/command-line.md.
enum ExitCode {
  kDone = 0,
  kInternalError = 1,   ///< a defect of the program
  kUsage = 2,           ///< the command line itself is wrong
  kBadInput = 3,        ///< a file or a value in it is wrong, or a file cannot be read or written
  kCannotBeSolved = 4,  ///< the input is valid but has no solution here: not supported, too large,
                        ///< …; or `verify` found errors above their tolerances
  kCancelled = 5,       ///< interrupted by the user
};

}  // namespace palpa::cli

#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/verification/verification.h"

namespace palpa::cli {

/// What `verify` found, for people and programs.
class VerifyReport {
 public:
  explicit VerifyReport(std::vector<verification::Omitted> omitted)
      : omitted_(std::move(omitted)) {}

  void add(verification::Result result) { results_.push_back(std::move(result)); }
  const std::vector<verification::Result>& results() const { return results_; }

  int failures() const;  ///< checks that do not pass
  Json json() const;
  /// One line per result with the check that is nearest to its bound, or with `all` every check;
  /// checks that fail always.
  std::string text(bool all) const;

 private:
  int checks() const;
  double seconds() const;
  std::string tableOfChecks(bool all) const;
  std::string tablesOfSteps() const;
  std::string omissions() const;

  std::vector<verification::Result> results_;
  std::vector<verification::Omitted> omitted_;
};

}  // namespace palpa::cli

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/core/results/field_sample.h"

namespace palpa::cli {

/// The option --sample: points of the surface at which a command reports the field. --probe is its
/// former name.
class SampleOptions {
 public:
  void declare(CLI::App& options);

  /// Throws UsageError if a value is no vector. Writes a notice if --probe is given.
  void validate() const;

  bool isGiven() const { return !points_.empty() || !formerPoints_.empty(); }
  bool hasFormerName() const { return !formerPoints_.empty(); }

  /// One sample per point, in the order of the command line. Throws as app::sampleField().
  std::vector<app::FieldSample> evaluate(const app::TouchModel& model,
                                         const app::TouchState& state) const;

 private:
  std::vector<Eigen::Vector3d> points() const;

  std::vector<std::string> points_, formerPoints_;
};

}  // namespace palpa::cli

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modeling/error.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::app {

/// The surface is not the boundary of a body, so nothing is computed on it. what() is the sentence
/// of the first error.
class GeometryError : public modeling::ModelingError {
 public:
  using Findings = std::shared_ptr<const std::vector<modeling::GeometryFinding>>;

  /// `findings`: of checkGeometry(), at least one, errors first.
  explicit GeometryError(Findings findings)
      : ModelingError(findings->front().message), findings_(std::move(findings)) {}

  /// All that was found, errors first, warnings included.
  const Findings& findings() const { return findings_; }

 private:
  Findings findings_;
};

}  // namespace palpa::app

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modeling/error.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::app {

/// Thrown if the surface is not the boundary of a body. what() is the message of the first error.
class GeometryError : public modeling::ModelingError {
 public:
  using Findings = std::shared_ptr<const std::vector<modeling::GeometryFinding>>;

  /// `findings`: of checkGeometry(), at least one, errors first.
  explicit GeometryError(Findings findings)
      : ModelingError(findings->front().message), findings_(std::move(findings)) {}

  /// All findings, errors first, warnings included.
  const Findings& findings() const { return findings_; }

 private:
  Findings findings_;
};

}  // namespace palpa::app

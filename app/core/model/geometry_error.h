#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "modeling/error.h"
#include "modeling/mesh/geometry_check.h"

namespace palpa::app {

/// Thrown if the surface is not the boundary of a body. what() is the message of the first error
/// and its remedy.
class GeometryError : public modeling::ModelingError {
 public:
  using Findings = std::shared_ptr<const std::vector<modeling::GeometryFinding>>;

  /// `findings`: of checkGeometry() for the body, at least one, errors first.
  GeometryError(Findings findings, const modeling::Body& body)
      : ModelingError(findings->front().message + remedyFor(body)),
        findings_(std::move(findings)) {}

  /// All findings, errors first, warnings included.
  const Findings& findings() const { return findings_; }

 private:
  static const char* remedyFor(const modeling::Body& body) {
    return std::holds_alternative<modeling::Solid>(body)
               ? "; move its control points apart there"
               : "; choose another edge length, or repair the surface in the program that made it";
  }

  Findings findings_;
};

}  // namespace palpa::app

#pragma once

#include <Eigen/Core>
#include <string>

#include "bem/base/error.h"
#include "modeling/editing/command.h"

namespace palpa::app {

/// Two supports that prescribe different displacements at one place.
struct SupportConflict {
  std::string first, second;                     ///< names, in the order of the project
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< mm
  bool overlaps = true;                          ///< false: the supports only meet along a line

  bool operator==(const SupportConflict&) const = default;
};

/// Thrown if supports prescribe different displacements at one place (kBadCondition).
class SupportConflictError : public bem::SolverError {
 public:
  explicit SupportConflictError(SupportConflict conflict);
  const SupportConflict& conflict() const { return conflict_; }

 private:
  SupportConflict conflict_;
};

/// Command that ends a conflict: one support keeps the place; the other one ends half an
/// edge length before it, because the displacement of the surface between both must be continuous.
modeling::TakeOverlap resolution(const SupportConflict& conflict, bool firstKeeps,
                                 const modeling::Project& project);

}  // namespace palpa::app

#pragma once

#include <Eigen/Core>

#include "modeling/error.h"

namespace palpa::modeling {

/// Error of a profile curve at a known location, which an editor can mark.
class ProfileError : public ModelingError {
 public:
  /// `location` in the plane of the profile, mm.
  ProfileError(const std::string& message, Eigen::Vector2d location)
      : ModelingError(message), location_(std::move(location)) {}

  const Eigen::Vector2d& location() const { return location_; }

 private:
  Eigen::Vector2d location_;
};

}  // namespace palpa::modeling

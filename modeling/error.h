#pragma once

#include <string>
#include <utility>

#include "base/error.h"

namespace palpa::modeling {

/// Error of the library: a bad file, an impossible solid, or a mesh beyond the limits. The message
/// begins with the place, as a path in the project file if there is one. Callers distinguish the
/// cases by kind(), never by the text of the message.
class ModelingError : public Error {
 public:
  enum class Kind {
    kBadInput,  ///< a value or a file's content breaks a rule
    kNotFound,  ///< a file or a named thing does not exist
    kIo,        ///< reading or writing failed
    kTooLarge,  ///< the request exceeds a stated limit
  };

  explicit ModelingError(const std::string& message, Kind kind = Kind::kBadInput)
      : Error(message), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Thrown if a region contains no part of the surface that a mesh can resolve.
class EmptyRegionError : public ModelingError {
 public:
  /// `region`: as MeshRegion::name.
  EmptyRegionError(std::string region, const std::string& message)
      : ModelingError(message), region_(std::move(region)) {}
  const std::string& region() const { return region_; }

 private:
  std::string region_;
};

}  // namespace palpa::modeling

#pragma once

#include "modeling/error.h"

namespace palpa::modeling {

/// Thrown if gravity acts on a material without density.
class MissingDensityError : public ModelingError {
 public:
  using ModelingError::ModelingError;
};

}  // namespace palpa::modeling

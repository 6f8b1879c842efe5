#pragma once

#include <cmath>
#include <string>

#include "bem/base/error.h"

namespace palpa::bem {

/// Homogeneous isotropic linear elasticity, small strain.
struct Material {
  double youngsModulus = 1.0;  ///< E in MPa, > 0
  double poissonRatio = 0.3;   ///< nu in (-1, 0.5]; 0.5 is incompressible and allowed

  /// Shear modulus E / (2 (1 + nu)) in MPa.
  double shear() const { return youngsModulus / (2.0 * (1.0 + poissonRatio)); }

  /// Throws SolverError (kBadMaterial) naming the field that is out of range.
  void validate() const {
    if (!(std::isfinite(youngsModulus) && youngsModulus > 0))
      throw SolverError(SolverError::Kind::kBadMaterial,
                        "Young's modulus is " + std::to_string(youngsModulus) +
                            " MPa; it must be a finite number greater than 0");
    if (!(poissonRatio > -1.0 && poissonRatio <= 0.5))
      throw SolverError(SolverError::Kind::kBadMaterial,
                        "Poisson's ratio is " + std::to_string(poissonRatio) +
                            "; it must be greater than -1 and at most 0.5");
  }
};

}  // namespace palpa::bem

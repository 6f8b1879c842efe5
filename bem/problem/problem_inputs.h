#pragma once

#include <vector>

#include "bem/model/boundary_conditions.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Accuracy of the operators.
struct AssemblyOptions {
  /// Relative error allowed in the integrals over one element, measured against the norm of their
  /// 3 x 3 block. Supported range [1e-9, 1e-3].
  double tolerance = 1e-7;
};

/// How operators are stored and factorised.
enum class Precision {
  kAutomatic,  ///< dense: double up to about 800 nodes, single beyond; compressed quadratic
               ///< triangles from kCompressedFrom nodes on
  kDouble,     ///< everything in double: 24 (3n)^2 bytes
  kMixed,      ///< H and G in double, factors in single, refined: 20 (3n)^2 bytes
  kSingle,     ///< everything stored in single, solved with residuals in double: 12 (3n)^2 bytes
  kCompressed  ///< in compressed blocks of single precision; quadratic triangles only
};

/// What determines a reference problem besides the shape of the body.
struct ProblemInputs {
  std::vector<SlotCondition> conditions;  ///< one per traction slot
  Material material;
  AssemblyOptions assembly = {};
  Precision precision = Precision::kAutomatic;
};

/// Durations of the stages of makeDenseReferenceProblem().
struct ReferenceProblemTimes {
  double assemble = 0;   ///< s
  double factorise = 0;  ///< s
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/element/element_equations.h"
#include "bem/quadratic/quadratic_discretisation.h"

namespace palpa::bem {

/// Exact products of rows of H with rigid motions of the nodes, mm.
struct RigidProducts {
  Eigen::MatrixXd motions;     ///< rigidMotions() of the nodes about their centroid
  Eigen::MatrixXd products;    ///< [i * (number of equations) + e][motion]
  std::vector<bool> areKnown;  ///< per equation
};

/// A rigid motion has no tractions, so its products vanish, but beside the borders of supports the
/// displacement functions of curved elements do not follow rotations exactly (BorderCoordinates).
/// There the difference is integrated. The products of equations with points in elements beside a
/// border are not known if some are curved; none are known if so many are curved that the
/// integration would take long. Throws Cancelled.
RigidProducts rigidProducts(const QuadraticDiscretisation& on, const WeightedEquations& equations,
                            const Material& material, const AssemblyOptions& options,
                            const Job& job);

}  // namespace palpa::bem

#pragma once

#include "base/job.h"
#include "bem/element/element_equations.h"
#include "bem/element/element_quadrature.h"
#include "bem/model/body_force.h"

namespace palpa::bem {

/// Term of a uniform body force in the boundary integral equation on curved elements, by the rules
/// of the quadrature: its kernel is smoother than Kelvin's kernels, for which they were chosen.
/// Const use from several threads is safe; the quadrature must outlive it.
class ElementBodyForce {
 public:
  ElementBodyForce(const ElementSurface& surface, const ElementQuadrature& quadrature,
                   const Bulk& bulk)
      : elementCount_(surface.elementCount()), quadrature_(quadrature), bulk_(bulk) {}

  /// B(x), mm, at a point of the surface; zero without a body force. About 0.1 µs per element.
  Eigen::Vector3d at(const CollocationPlace& x, ElementQuadrature::Workspace& work) const;
  /// The weighted sums of B in the rows of the equations: component c of equation k in row c m + k.
  /// Throws Cancelled.
  Eigen::VectorXd term(const WeightedEquations& equations, const Job& job) const;

 private:
  int elementCount_;
  const ElementQuadrature& quadrature_;
  Bulk bulk_;
};

}  // namespace palpa::bem

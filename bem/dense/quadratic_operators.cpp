#include "bem/dense/quadratic_operators.h"

#include <algorithm>

#include "base/parallel.h"
#include "bem/dense/dense_reference_problem.h"
#include "bem/element/rigid_motions.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/rigid_products.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::MatrixXd;

template <class Scalar>
BoundaryOperators<Scalar> makeQuadraticOperators(const QuadraticDiscretisation& on,
                                                 const WeightedEquations& equations,
                                                 const Material& material,
                                                 const AssemblyOptions& options, const Job& job) {
  auto operators = assemble<Scalar>(on.surface(), equations, material, options, job);
  const RigidProducts exact = rigidProducts(on, equations, material, options, job);
  const Index count = equations.weights.rows();
  MatrixXd residuals = -exact.products;
  addProduct<Scalar>(operators.H, exact.motions, residuals, job);
  const RigidCorrection correction(on.surface(), equations, exact.motions);
  auto H = operators.H.view();
  constexpr Index kPerTask = 64;
  parallelFor((count + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
    for (Index e = task * kPerTask; e < std::min(count, (task + 1) * kPerTask); ++e) {
      if (!exact.areKnown[e]) continue;
      const auto rows = Eigen::seqN(e, 3, count);
      for (const auto& [node, block] : correction.blocks(e, residuals(rows, Eigen::all)))
        for (int c = 0; c < 3; ++c)
          H.col(3 * node + c)(rows) += block.col(c).template cast<Scalar>();
    }
  });
  return operators;
}

template BoundaryOperators<double> makeQuadraticOperators(const QuadraticDiscretisation&,
                                                          const WeightedEquations&, const Material&,
                                                          const AssemblyOptions&, const Job&);
template BoundaryOperators<float> makeQuadraticOperators(const QuadraticDiscretisation&,
                                                         const WeightedEquations&, const Material&,
                                                         const AssemblyOptions&, const Job&);

}  // namespace palpa::bem

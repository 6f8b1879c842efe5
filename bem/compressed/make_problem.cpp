#include "bem/compressed/make_problem.h"

#include <chrono>

#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/quadratic/quadratic_quadrature.h"

namespace palpa::bem {

std::unique_ptr<CompressedReferenceProblem> makeCompressedReferenceProblem(
    const QuadraticDiscretisation& on, const ProblemInputs& inputs,
    const CompressionOptions& options, const Job& job, ReferenceProblemTimes* times) {
  inputs.material.validate();
  on.checkSolvable(inputs.conditions, inputs.material);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  DegreesOfFreedom dofs = on.degreesOfFreedom(inputs.conditions, inputs.material);
  CompressedOperators operators = [&] {
    const WeightedEquations equations =
        quadraticEquations(on.surface(), on.mesh(), on.slots(), dofs);
    const QuadraticQuadrature quadrature(on.surface(), inputs.assembly.tolerance);
    return assembleCompressed(on.surface(), quadrature, equations, on.places(), on.slots(),
                              inputs.material, options.operators, job);
  }();
  const double assembled = seconds();
  auto problem = std::make_unique<CompressedReferenceProblem>(std::move(dofs), std::move(operators),
                                                              options, job);
  if (times) *times = {assembled, seconds() - assembled};
  return problem;
}

}  // namespace palpa::bem

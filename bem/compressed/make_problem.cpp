#include "bem/compressed/make_problem.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/freed_memory.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/quadratic/quadratic_quadrature.h"
#include "bem/quadratic/rigid_products.h"

namespace palpa::bem {

bool isCompressed(Precision wanted, bool isQuadratic, double nodeCount) {
  if (!isQuadratic) return false;
  return wanted == Precision::kCompressed ||
         (wanted == Precision::kAutomatic && nodeCount >= kCompressedFrom);
}

ProblemSize sizeOf(const Discretisation& discretisation) {
  ProblemSize size{static_cast<double>(discretisation.displacementCount()),
                   static_cast<double>(discretisation.slots().count())};
  if (const auto* on = dynamic_cast<const QuadraticDiscretisation*>(&discretisation))
    size.thinShare = thinShare(on->surface());
  return size;
}

namespace {

constexpr double kSmallTolerance = 3e-6, kUsualTolerance = 3e-5;

}  // namespace

double operatorTolerance(const ProblemSize& size) {
  // The small one takes 6 % more memory, which large bodies without thin parts save: their forces
  // stay the same to 1e-5.
  constexpr double kManyNodes = 10e3, kThinShare = 0.01;
  return size.nodes < kManyNodes || size.thinShare > kThinShare ? kSmallTolerance : kUsualTolerance;
}

double expectedBytes(const ProblemSize& size, bool isQuadratic, Precision precision) {
  if (isCompressed(precision, isQuadratic, size.nodes)) {
    // Spheres of 3,500 to 46,700 nodes take 76 to 83 KB per node at their peak, within 8 % of
    // this. Five CAD parts with thin walls and pins were within 21 %, but a row of pins took 40 %
    // less.
    constexpr double kAtThousand = 74e3, kPerDoubling = 1.0e3, kOfThin = 140e3;
    const double ofTolerance = operatorTolerance(size) == kSmallTolerance ? 1.06 : 1;
    return ofTolerance * (size.nodes + size.slots) / 2 *
           (kAtThousand + kPerDoubling * std::max(0.0, std::log2(size.nodes / 1000)) +
            kOfThin * size.thinShare);
  }
  // Numbers beyond the range of int are still to be reported.
  const double nodes = std::min(size.nodes, 1e8), slots = std::min(size.slots, 1e8);
  return estimateBytes(static_cast<int>(nodes), static_cast<int>(slots), precision) *
         (size.nodes / nodes) * (size.nodes / nodes);
}

std::unique_ptr<ReferenceProblem> makeReferenceProblem(const Discretisation& discretisation,
                                                       const ProblemInputs& inputs, const Job& job,
                                                       ReferenceProblemTimes* times) {
  if (effectivePrecision(discretisation, inputs.precision) == Precision::kCompressed)
    return makeCompressedReferenceProblem(
        dynamic_cast<const QuadraticDiscretisation&>(discretisation), inputs, {}, job, times);
  return makeDenseReferenceProblem(discretisation, inputs, job, times);
}

Precision effectivePrecision(const Discretisation& discretisation, Precision wanted) {
  const bool isQuadratic = dynamic_cast<const QuadraticDiscretisation*>(&discretisation) != nullptr;
  return isCompressed(wanted, isQuadratic, discretisation.displacementCount())
             ? Precision::kCompressed
             : choosePrecision(wanted, discretisation.displacementCount());
}

std::unique_ptr<ReferenceProblem> readReferenceProblem(const Discretisation& discretisation,
                                                       const ProblemInputs& inputs,
                                                       const ByteSource& source) {
  if (effectivePrecision(discretisation, inputs.precision) != Precision::kCompressed)
    return readDenseReferenceProblem(discretisation, inputs, source);
  return std::make_unique<CompressedReferenceProblem>(
      discretisation.degreesOfFreedom(inputs.conditions, inputs.material), source);
}

std::unique_ptr<CompressedReferenceProblem> makeCompressedReferenceProblem(
    const QuadraticDiscretisation& on, const ProblemInputs& inputs,
    const CompressionOptions& options, const Job& job, ReferenceProblemTimes* times,
    const Team* team) {
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
    const RigidProducts rigid = rigidProducts(on, equations, inputs.material, inputs.assembly, job);
    return assembleCompressed(
        on.surface(), quadrature, equations, on.places(), on.slots(), inputs.material, rigid,
        options.operators > 0 ? options.operators : operatorTolerance(sizeOf(on)), job, team);
  }();
  returnFreedMemory();
  const double assembled = seconds();
  auto problem = std::make_unique<CompressedReferenceProblem>(std::move(dofs), std::move(operators),
                                                              options, job, team);
  if (times) *times = {assembled, seconds() - assembled};
  return problem;
}

}  // namespace palpa::bem

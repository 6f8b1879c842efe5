#include "bem/dense/make_reference_problem.h"

#include <chrono>

#include "bem/dense/dense_reference_problem.h"
#include "bem/dense/quadratic_operators.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/spline/spline_assembly.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::bem {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Calls make(Stored{}, Factor{}) for the scalars of a precision.
template <class Make>
std::unique_ptr<ReferenceProblem> inPrecision(Precision precision, const DegreesOfFreedom& dofs,
                                              const Make& make) {
  switch (choosePrecision(precision, dofs.nodeCount())) {
    case Precision::kMixed:
      return make(double{}, float{});
    case Precision::kSingle:
      return make(float{}, float{});
    default:
      return make(double{}, double{});
  }
}

/// `assembleOperators(Scalar{})` yields the operators in the precision of a Scalar.
template <class Assemble>
std::unique_ptr<ReferenceProblem> make(Precision precision, DegreesOfFreedom dofs,
                                       const Assemble& assembleOperators, const Job& job,
                                       ReferenceProblemTimes* times) {
  return inPrecision(precision, dofs, [&](auto stored, auto factor) {
    const auto start = std::chrono::steady_clock::now();
    auto operators = assembleOperators(stored);
    if (times) times->assemble = secondsSince(start);
    const auto assembled = std::chrono::steady_clock::now();
    auto problem = std::make_unique<DenseReferenceProblem<decltype(stored), decltype(factor)>>(
        std::move(dofs), std::move(operators), job);
    if (times) times->factorise = secondsSince(assembled);
    return problem;
  });
}

std::unique_ptr<ReferenceProblem> read(Precision precision, DegreesOfFreedom dofs,
                                       const ByteSource& source) {
  return inPrecision(precision, dofs, [&](auto stored, auto factor) {
    return std::make_unique<DenseReferenceProblem<decltype(stored), decltype(factor)>>(
        std::move(dofs), source);
  });
}

DegreesOfFreedom solvableDofs(const BoundaryMesh& mesh, const TractionSlots& slots,
                              const ProblemInputs& inputs) {
  inputs.material.validate();
  DegreesOfFreedom dofs(mesh, slots, inputs.conditions, inputs.material);
  checkSolvable(mesh, inputs.conditions, dofs, inputs.material);
  return dofs;
}

DegreesOfFreedom solvableDofs(const SplineSurface& surface, const SplineTractions& tractions,
                              const ProblemInputs& inputs) {
  inputs.material.validate();
  const double size = surface.boundingSize();
  DegreesOfFreedom dofs(tractions.slots, inputs.conditions, inputs.material, size);
  checkSolvable(surface.controlPoints(), size, surface.closedSurfaceCount(), inputs.conditions,
                dofs, inputs.material);
  return dofs;
}

std::unique_ptr<ReferenceProblem> makeQuadratic(const QuadraticDiscretisation& on,
                                                const ProblemInputs& inputs, const Job& job,
                                                ReferenceProblemTimes* times) {
  inputs.material.validate();
  on.checkSolvable(inputs.conditions, inputs.material);
  DegreesOfFreedom dofs = on.degreesOfFreedom(inputs.conditions, inputs.material);
  const WeightedEquations equations = quadraticEquations(on.surface(), on.mesh(), on.slots(), dofs);
  return make(
      inputs.precision, std::move(dofs),
      [&](auto scalar) {
        return makeQuadraticOperators<decltype(scalar)>(on, equations, inputs.material,
                                                        inputs.assembly, job);
      },
      job, times);
}

}  // namespace

Precision choosePrecision(Precision wanted, int nodeCount) {
  // Double factors take twice as long as single ones; up to this size they fit the rebuild budget
  // of a small body.
  constexpr int kDoubleUpTo = 800;
  if (wanted != Precision::kAutomatic) return wanted;
  return nodeCount <= kDoubleUpTo ? Precision::kDouble : Precision::kSingle;
}

double estimateBytes(int nodeCount, int slotCount, Precision precision) {
  const Precision chosen = choosePrecision(precision, nodeCount);
  const double n = 3.0 * nodeCount, q = 3.0 * slotCount;
  const double stored = chosen == Precision::kSingle ? 4 : 8;
  const double factor = chosen == Precision::kDouble ? 8 : 4;
  return n * (n * stored + q * stored + n * factor);
}

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const BoundaryMesh& mesh,
                                                            const TractionSlots& slots,
                                                            const ProblemInputs& inputs,
                                                            const Job& job,
                                                            ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(mesh, slots, inputs);
  const auto points = dofs.collocationPoints(mesh, slots);
  return make(
      inputs.precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(mesh, slots, points, inputs.material, inputs.assembly,
                                          job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const SplineSurface& surface,
                                                            const SplineTractions& tractions,
                                                            const ProblemInputs& inputs,
                                                            const Job& job,
                                                            ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(surface, tractions, inputs);
  const WeightedEquations equations = splineEquations(surface, tractions, dofs.extraSlots());
  return make(
      inputs.precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(surface, tractions, equations, inputs.material,
                                          inputs.assembly, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(const Discretisation& discretisation,
                                                            const ProblemInputs& inputs,
                                                            const Job& job,
                                                            ReferenceProblemTimes* times) {
  if (const auto* splines = dynamic_cast<const SplineDiscretisation*>(&discretisation))
    return makeDenseReferenceProblem(splines->surface(), splines->tractions(), inputs, job, times);
  if (const auto* quadratic = dynamic_cast<const QuadraticDiscretisation*>(&discretisation))
    return makeQuadratic(*quadratic, inputs, job, times);
  const auto& triangles = dynamic_cast<const TriangleDiscretisation&>(discretisation);
  return makeDenseReferenceProblem(triangles.mesh(), triangles.slots(), inputs, job, times);
}

std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(const Discretisation& discretisation,
                                                            const ProblemInputs& inputs,
                                                            const ByteSource& source) {
  inputs.material.validate();
  discretisation.checkSolvable(inputs.conditions, inputs.material);
  return read(inputs.precision, discretisation.degreesOfFreedom(inputs.conditions, inputs.material),
              source);
}

}  // namespace palpa::bem

#include <chrono>

#include "bem/dense_reference_problem.h"
#include "bem/spline/spline_assembly.h"

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
                              const std::vector<SlotCondition>& conditions,
                              const Material& material) {
  material.validate();
  DegreesOfFreedom dofs(mesh, slots, conditions, material);
  checkSolvable(mesh, conditions, dofs, material);
  return dofs;
}

DegreesOfFreedom solvableDofs(const SplineSurface& surface, const SplineTractions& tractions,
                              const std::vector<SlotCondition>& conditions,
                              const Material& material) {
  material.validate();
  const double size = surface.boundingSize();
  DegreesOfFreedom dofs(tractions.slots, conditions, material, size);
  checkSolvable(surface.controlPoints(), size, surface.closedSurfaceCount(), conditions, dofs,
                material);
  return dofs;
}

}  // namespace

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(mesh, slots, conditions, material);
  const auto points = dofs.collocationPoints(mesh, slots);
  return make(
      precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(mesh, slots, points, material, options, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> makeDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material,
    const AssemblyOptions& options, Precision precision, const Job& job,
    ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = solvableDofs(surface, tractions, conditions, material);
  const SplineEquations equations = splineEquations(surface, tractions, dofs.extraSlots());
  return make(
      precision, std::move(dofs),
      [&](auto scalar) {
        return assemble<decltype(scalar)>(surface, tractions, equations, material, options, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const BoundaryMesh& mesh, const TractionSlots& slots,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source) {
  return read(precision, solvableDofs(mesh, slots, conditions, material), source);
}

std::unique_ptr<ReferenceProblem> readDenseReferenceProblem(
    const SplineSurface& surface, const SplineTractions& tractions,
    const std::vector<SlotCondition>& conditions, const Material& material, Precision precision,
    const ByteSource& source) {
  return read(precision, solvableDofs(surface, tractions, conditions, material), source);
}

}  // namespace palpa::bem

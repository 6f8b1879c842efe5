#include "bem/dense/update_reference_problem.h"

#include <algorithm>
#include <chrono>
#include <typeinfo>

#include "base/parallel.h"
#include "bem/dense/moved_part.h"
#include "bem/dense/quadratic_operators.h"
#include "bem/dense/updated_reference_problem.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bem/spline/spline_assembly.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/triangle/triangle_discretisation.h"

namespace palpa::bem {
namespace {

/// Largest share of a full assembly for which an update pays.
constexpr double kMaxShare = 0.75;

/// True if the same directions and slots of the same coefficients have unknowns.
bool isAlike(const DegreesOfFreedom& a, const DegreesOfFreedom& b) {
  if (a.nodeCount() != b.nodeCount() || a.slotCount() != b.slotCount() ||
      a.extraSlots() != b.extraSlots())
    return false;
  for (int k = 0; k < a.nodeCount(); ++k)
    if (a.constrained(k) != b.constrained(k)) return false;
  return true;
}

/// Subtracts the rows of the base from new rows.
template <class Scalar>
void subtractRows(const LargeMatrix<Scalar>& base, const std::vector<int>& equations,
                  LargeMatrix<Scalar>& rows, const Job& job) {
  constexpr std::ptrdiff_t kColumnsPerTask = 256;
  const Eigen::Index some = static_cast<Eigen::Index>(equations.size()), all = base.rows() / 3;
  parallelFor((base.cols() + kColumnsPerTask - 1) / kColumnsPerTask, job, [&](std::ptrdiff_t task) {
    const auto end = std::min<Eigen::Index>(base.cols(), (task + 1) * kColumnsPerTask);
    for (Eigen::Index j = task * kColumnsPerTask; j < end; ++j)
      for (int c = 0; c < 3; ++c)
        for (Eigen::Index k = 0; k < some; ++k)
          rows.data()[j * rows.rows() + c * some + k] -=
              base.data()[j * base.rows() + c * all + equations[k]];
  });
}

template <class Scalar>
void subtract(const LargeMatrix<Scalar>& old, LargeMatrix<Scalar>& matrix) {
  matrix.view() -= old.view();
}

/// `newRows`(scalar, equations): rows of the new operators; `partBefore` and `partAfter` (scalar,
/// part, others): contribution of the moved elements to the other rows. The scalar gives the
/// precision.
template <class Scalar, class Rows, class Before, class After>
OperatorChange<Scalar> changeOf(const BoundaryOperators<Scalar>& base, MovedPart part,
                                const Rows& newRows, const Before& partBefore,
                                const After& partAfter, const Job& job) {
  OperatorChange<Scalar> change;
  change.equations = part.equations();
  change.others = part.others();
  job.report(Phase::kAssemble, 0);
  change.rows = newRows(Scalar{}, change.equations);
  subtractRows(base.H, change.equations, change.rows.H, job);
  subtractRows(base.G, change.equations, change.rows.G, job);
  job.report(Phase::kAssemble, 0.4);
  change.columns = partAfter(Scalar{}, part.moved, change.others);
  job.report(Phase::kAssemble, 0.7);
  const BoundaryOperators<Scalar> old = partBefore(Scalar{}, part.moved, change.others);
  subtract(old.H, change.columns.H);
  subtract(old.G, change.columns.G);
  job.report(Phase::kAssemble, 1);
  change.moved = std::move(part.moved);
  return change;
}

/// Calls make(problem) for the kind of dense problem that `base` is; null for another.
template <class Make>
std::unique_ptr<ReferenceProblem> forDense(const std::shared_ptr<const ReferenceProblem>& base,
                                           const Make& make) {
  if (auto dense = std::dynamic_pointer_cast<const DenseReferenceProblem<float, float>>(base))
    return make(std::move(dense));
  if (auto dense = std::dynamic_pointer_cast<const DenseReferenceProblem<double, double>>(base))
    return make(std::move(dense));
  if (auto dense = std::dynamic_pointer_cast<const DenseReferenceProblem<double, float>>(base))
    return make(std::move(dense));
  return nullptr;
}

template <class Rows, class Before, class After>
std::unique_ptr<ReferenceProblem> update(const std::shared_ptr<const ReferenceProblem>& base,
                                         DegreesOfFreedom dofs, MovedPart part, const Rows& newRows,
                                         const Before& partBefore, const After& partAfter,
                                         const Job& job, ReferenceProblemTimes* times) {
  return forDense(
      base,
      [&]<class Stored, class Factor>(
          std::shared_ptr<const DenseReferenceProblem<Stored, Factor>> dense)
          -> std::unique_ptr<ReferenceProblem> {
        const auto start = std::chrono::steady_clock::now();
        auto change = changeOf<Stored>(dense->operators(), std::move(part), newRows, partBefore,
                                       partAfter, job);
        if (times)
          *times = {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                    0};
        dofs.setTractionScale(dense->dofs().tractionScale());
        return std::make_unique<UpdatedReferenceProblem<Stored, Factor>>(
            std::move(dofs), std::move(dense), std::move(change));
      });
}

std::unique_ptr<ReferenceProblem> updateTriangles(
    const std::shared_ptr<const ReferenceProblem>& base, const BoundaryMesh& before,
    const BoundaryMesh& mesh, const TractionSlots& slots, const ProblemInputs& inputs,
    const Job& job, ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs(mesh, slots, inputs.conditions, inputs.material);
  if (!isAlike(base->dofs(), dofs)) return nullptr;
  const TractionSlots slotsBefore(before);
  const auto points = dofs.collocationPoints(mesh, slots);
  auto moved = findMovedPart(before, mesh, slots,
                             base->dofs().collocationPoints(before, slotsBefore), points);
  if (!moved || moved->share(mesh.triangleCount()) > kMaxShare) return nullptr;
  const auto some = [&](const std::vector<int>& equations) {
    std::vector<CollocationPoint> chosen;
    for (const int e : equations) chosen.push_back(points[e]);
    return chosen;
  };
  return update(
      base, std::move(dofs), std::move(*moved),
      [&]<class Scalar>(Scalar, const std::vector<int>& equations) {
        return assemble<Scalar>(mesh, slots, some(equations), inputs.material, inputs.assembly,
                                job);
      },
      [&]<class Scalar>(Scalar, const ElementPart& part, const std::vector<int>& equations) {
        return assemblePart<Scalar>(before, slotsBefore, part, some(equations), inputs.material,
                                    inputs.assembly, job);
      },
      [&]<class Scalar>(Scalar, const ElementPart& part, const std::vector<int>& equations) {
        return assemblePart<Scalar>(mesh, slots, part, some(equations), inputs.material,
                                    inputs.assembly, job);
      },
      job, times);
}

std::unique_ptr<ReferenceProblem> updateSplines(const std::shared_ptr<const ReferenceProblem>& base,
                                                const SplineSurface& before,
                                                const SplineSurface& surface,
                                                const SplineTractions& tractions,
                                                const ProblemInputs& inputs, const Job& job,
                                                ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs(tractions.slots, inputs.conditions, inputs.material,
                        surface.boundingSize());
  if (!isAlike(base->dofs(), dofs)) return nullptr;
  const WeightedEquations equations = splineEquations(surface, tractions, dofs.extraSlots());
  auto moved =
      findMovedPart(surface.movedElements(before), SplineElements(surface, tractions),
                    splineEquations(before, SplineTractions(before), dofs.extraSlots()), equations);
  if (!moved || moved->share(surface.elementCount()) > kMaxShare) return nullptr;
  const auto partOn = [&](const SplineSurface& shape) {
    return [&]<class Scalar>(Scalar, const ElementPart& part, const std::vector<int>& some) {
      return assemblePart<Scalar>(shape, tractions, part, equations.only(some), inputs.material,
                                  inputs.assembly, job);
    };
  };
  return update(
      base, std::move(dofs), std::move(*moved),
      [&]<class Scalar>(Scalar, const std::vector<int>& some) {
        return assemble<Scalar>(surface, tractions, equations.only(some), inputs.material,
                                inputs.assembly, job);
      },
      partOn(before), partOn(surface), job, times);
}

std::unique_ptr<ReferenceProblem> updateQuadratic(
    const std::shared_ptr<const ReferenceProblem>& base, const QuadraticDiscretisation& before,
    const QuadraticDiscretisation& after, const ProblemInputs& inputs, const Job& job,
    ReferenceProblemTimes* times) {
  DegreesOfFreedom dofs = after.degreesOfFreedom(inputs.conditions, inputs.material);
  if (!isAlike(base->dofs(), dofs)) return nullptr;
  const auto equationsOn = [&](const QuadraticDiscretisation& on) {
    return quadraticEquations(on.surface(), on.mesh(), on.slots(), dofs);
  };
  auto elements = movedElements(before, after);
  if (!elements) return nullptr;
  const WeightedEquations equations = equationsOn(after);
  auto moved = findMovedPart(std::move(elements), after.surface(), equationsOn(before), equations);
  if (!moved || moved->share(after.elementCount()) > kMaxShare) return nullptr;
  const auto partOn = [&](const QuadraticSurface& surface) {
    return [&]<class Scalar>(Scalar, const ElementPart& part, const std::vector<int>& some) {
      return assemblePart<Scalar>(surface, part, equations.only(some), inputs.material,
                                  inputs.assembly, job);
    };
  };
  return update(
      base, std::move(dofs), std::move(*moved),
      [&]<class Scalar>(Scalar, const std::vector<int>& some) {
        return makeQuadraticOperators<Scalar>(after, equations.only(some), inputs.material,
                                              inputs.assembly, job);
      },
      partOn(before.surface()), partOn(after.surface()), job, times);
}

}  // namespace

std::unique_ptr<ReferenceProblem> updateDenseReferenceProblem(
    const std::shared_ptr<const ReferenceProblem>& base, const Discretisation& before,
    const Discretisation& after, const ProblemInputs& inputs, const Job& job,
    ReferenceProblemTimes* times) {
  if (typeid(before) != typeid(after)) return nullptr;
  if (const auto* splines = dynamic_cast<const SplineDiscretisation*>(&after))
    return updateSplines(base, dynamic_cast<const SplineDiscretisation&>(before).surface(),
                         splines->surface(), splines->tractions(), inputs, job, times);
  if (const auto* quadratic = dynamic_cast<const QuadraticDiscretisation*>(&after))
    return updateQuadratic(base, dynamic_cast<const QuadraticDiscretisation&>(before), *quadratic,
                           inputs, job, times);
  const auto& triangles = dynamic_cast<const TriangleDiscretisation&>(after);
  return updateTriangles(base, before.mesh(), triangles.mesh(), triangles.slots(), inputs, job,
                         times);
}

}  // namespace palpa::bem

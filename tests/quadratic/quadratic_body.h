#pragma once

#include <functional>
#include <memory>

#include "app/verification/exact/exact_fields.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/quadratic/quadratic_discretisation.h"

namespace palpa::bem::test {

using verification::ExactField;

/// Places the point at a fraction of an edge with the ends a and b (mm) on the true surface.
using PlaceMiddle = std::function<Eigen::Vector3d(const Eigen::Vector3d& a,
                                                  const Eigen::Vector3d& b, double share)>;

inline Eigen::Vector3d onFlatFaces(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   double share) {
  return (1 - share) * a + share * b;
}
/// The sphere about the origin.
PlaceMiddle onSphere(double radius);
/// The cylinder of verification::cylinderMesh().
PlaceMiddle onCylinder(double radius);

/// Quadratic triangles on a mesh of the corners. `supportTags`: of the triangles in supports.
std::unique_ptr<QuadraticDiscretisation> quadratic(const BoundaryMesh& corners,
                                                   const PlaceMiddle& middle,
                                                   const std::vector<int>& supportTags = {});

/// Relative difference of the displacements of an incremental update from a full build, from some
/// known values; infinite if there was no update.
double updateError(const QuadraticDiscretisation& before, const QuadraticDiscretisation& after,
                   const ProblemInputs& inputs);

/// A body of quadratic triangles with boundary data of an exact field, and its solution.
/// Displacements are prescribed at the nodes, tractions are projected.
struct QuadraticBody {
  QuadraticBody(std::unique_ptr<QuadraticDiscretisation> on, const Material& bodyMaterial,
                const ExactField& exact,
                const std::function<SlotCondition(int tag)>& conditionOfTag,
                const AssemblyOptions& options = {1e-6});

  std::unique_ptr<QuadraticDiscretisation> on;
  Material material;
  std::vector<SlotCondition> conditions;
  ReferenceProblemTimes times;
  std::unique_ptr<ReferenceProblem> problem;
  BoundaryField field;

  /// sqrt(∫ |u - exact|^2 / ∫ |exact|^2) over the surface.
  double displacementError(const ExactField& exact) const;
  /// Largest error of a traction over the largest exact value.
  double maxTractionError(const ExactField& exact) const;
};

}  // namespace palpa::bem::test

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/verification/exact/exact_fields.h"
#include "bem/problem/reference_problem.h"
#include "bem/spline/spline_projection.h"
#include "bem/spline/spline_surface.h"
#include "bem/spline/spline_tractions.h"
#include "modeling/solid/solid.h"

namespace palpa::verification {

/// A spline body whose boundary data were taken from an exact field, and its numerical solution:
/// displacements given where the tag is 1, tractions elsewhere, both L2-projected.
struct SplineBody {
  bem::SplineSurface surface;
  bem::SplineTractions tractions;
  bem::Material material;
  bem::ReferenceProblemTimes times;
  std::unique_ptr<bem::ReferenceProblem> problem;
  bem::BoundaryField field;

  /// Throws SolverError, Cancelled.
  SplineBody(bem::SplineSurface bodySurface, const bem::Material& bodyMaterial,
             const ExactField& exact, const bem::AssemblyOptions& options = {},
             bem::Precision precision = bem::Precision::kDouble, const Job& job = {});

  Eigen::Vector3d displacement(const bem::SplinePlace& place) const;
  Eigen::Vector3d traction(const bem::SplinePlace& place) const;
  /// sqrt(∫ |u - exact|^2 / ∫ |exact|^2) over the surface.
  double displacementError(const ExactField& exact) const;
  /// The same of the exact field's L2 projection: no other function of the space is nearer.
  double leastDisplacementError(const ExactField& exact) const;
  /// The same of the tractions, with the surface's true normals.
  double tractionError(const ExactField& exact) const;
  double area() const;  ///< mm^2
  /// Force (N) of the tractions on the held elements.
  Eigen::Vector3d reaction() const;
};

std::vector<int> allElements(const bem::SplineSurface& surface);

/// Position of the middle of an element's range of parameters, mm.
Eigen::Vector3d middleOf(const bem::SplineSurface& surface, int element);

/// The lowest one of the six patches of a sphere about the origin, or face of its cube.
bool isBelow(const Eigen::Vector3d& x);
modeling::Solid makeTorus(double ring, double tube);

/// Elements whose middle fulfils `held` get the tag 1.
bem::SplineSurface heldWhere(bem::SplineSurface surface,
                             const std::function<bool(const Eigen::Vector3d&)>& held);

/// The place nearest to a point, by ever finer sampling of every element.
bem::SplinePlace nearestPlace(const bem::SplineSurface& surface, const Eigen::Vector3d& point);

/// Every knot span of every patch divided into equal parts.
modeling::Solid divided(const modeling::Solid& solid, int parts);
inline modeling::Solid halved(const modeling::Solid& solid) {
  return divided(solid, 2);
}

}  // namespace palpa::verification

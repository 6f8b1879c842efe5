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

/// A spline body with boundary data of an exact field, and its numerical solution: displacements
/// are prescribed where the tag is 1, tractions elsewhere, both L2-projected.
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

  Eigen::Vector3d displacement(const bem::ElementPlace& place) const;
  Eigen::Vector3d traction(const bem::ElementPlace& place) const;
  /// sqrt(∫ |u - exact|^2 / ∫ |exact|^2) over the surface.
  double displacementError(const ExactField& exact) const;
  /// displacementError() of the exact field's L2 projection, the smallest error in the space.
  double leastDisplacementError(const ExactField& exact) const;
  /// The same norm of the error of the tractions, with the surface's exact normals.
  double tractionError(const ExactField& exact) const;
  double area() const;  ///< mm^2
  /// Force (N) of the tractions on the fixed elements.
  Eigen::Vector3d reaction() const;
};

std::vector<int> allElements(const bem::SplineSurface& surface);

/// Position of the middle of an element's range of parameters, mm.
Eigen::Vector3d middleOf(const bem::SplineSurface& surface, int element);

/// True on the lowest of the six patches of a sphere about the origin, or face of its cube.
bool isBelow(const Eigen::Vector3d& x);
modeling::Solid makeTorus(double ring, double tube);

/// The surface with the tag 1 for elements whose centre is fixed.
bem::SplineSurface fixedWhere(bem::SplineSurface surface,
                              const std::function<bool(const Eigen::Vector3d&)>& isFixed);

/// The place nearest to a point, by ever finer sampling of every element.
bem::ElementPlace nearestPlace(const bem::SplineSurface& surface, const Eigen::Vector3d& point);

/// Every knot span of every patch divided into equal parts.
modeling::Solid divided(const modeling::Solid& solid, int parts);
inline modeling::Solid halved(const modeling::Solid& solid) {
  return divided(solid, 2);
}

}  // namespace palpa::verification

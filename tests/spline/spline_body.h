#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

#include "app/core/spline_surface_of.h"
#include "bem/reference_problem.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_projection.h"
#include "exact_fields.h"
#include "modeling/shapes/primitives.h"

// Bodies of splines, and what tests of them include.

namespace palpa::bem::test {

/// A spline body whose boundary data were taken from an exact field, and its numerical solution:
/// displacements given where the tag is 1, tractions elsewhere, both L2-projected.
struct SplineBody {
  SplineSurface surface;
  SplineTractions tractions;
  Material material;
  ReferenceProblemTimes times;
  std::unique_ptr<ReferenceProblem> problem;
  BoundaryField field;

  SplineBody(SplineSurface bodySurface, const Material& bodyMaterial, const ExactField& exact,
             const AssemblyOptions& options = {}, Precision precision = Precision::kDouble);

  Eigen::Vector3d displacement(const SplinePlace& place) const;
  Eigen::Vector3d traction(const SplinePlace& place) const;
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

/// The discretisation of a solid whose elements have the tags that `tagOf` gives for their middles,
/// with a mesh of edges of some length on it, mm. Tags should change at borders of patches only:
/// triangles take that of the element under their middle.
std::unique_ptr<SplineDiscretisation> discretised(
    const modeling::Solid& solid, double edgeLength,
    const std::function<int(const Eigen::Vector3d&)>& tagOf);

/// Held where the tag is 1.
std::vector<SlotCondition> fixedWhereTagged(const TractionSlots& slots);

std::vector<int> allElements(const SplineSurface& surface);

/// The lower one of the six patches of a sphere.
bool isBelow(const Eigen::Vector3d& x);
modeling::Solid makeTorus(double ring, double tube);

/// Elements whose middle fulfils `held` get the tag 1.
SplineSurface heldWhere(SplineSurface surface,
                        const std::function<bool(const Eigen::Vector3d&)>& held);

/// The place nearest to a point, by ever finer sampling of every element.
SplinePlace nearestPlace(const SplineSurface& surface, const Eigen::Vector3d& point);

/// Every knot span of every patch divided into equal parts.
modeling::Solid divided(const modeling::Solid& solid, int parts);
inline modeling::Solid halved(const modeling::Solid& solid) {
  return divided(solid, 2);
}

}  // namespace palpa::bem::test

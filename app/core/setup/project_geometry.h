#pragma once

#include <optional>
#include <vector>

#include "app/core/setup/spline_refinement.h"
#include "modeling/project/project.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {

/// Radius of a touch that does not name one, mm: a fingertip, but at most a fifth of the body's
/// size (the diagonal of its box, mm).
double defaultTouchRadius(double bodySize);

/// Radius of a proposed touch, mm: the default one, but at least a twentieth of the body's size, as
/// a smaller touch on a large body needs a much finer mesh.
double radiusOfFirstTouch(double bodySize);

/// The narrowest touch that a project's model resolves anywhere, mm: a fingertip, or the narrowest
/// of the project's touches if all are wider.
double fingertipRadius(const modeling::Project& project);

/// True if the project's body is computed with splines, see modeling::engineOf().
bool usesSplines(const modeling::Project& project);

/// Geometry that a build derives from a project before it meshes the body, once: engine, regions
/// and, with splines, everything about the patches. Immutable. The project must outlive it.
class ProjectGeometry {
 public:
  /// Throws ModelingError (kTooLarge) if a patch would need too many spline elements.
  explicit ProjectGeometry(const modeling::Project& project);
  /// With splines on the given analysis net.
  ProjectGeometry(const modeling::Project& project, SplineRefinement refinement);

  const modeling::Project& project() const { return project_; }
  /// meshRegions() of the project.
  const std::vector<modeling::MeshRegion>& regions() const { return regions_; }
  bool usesSplines() const { return patches_.has_value(); }

  /// The body, which must be a solid.
  const modeling::Solid& solid() const { return std::get<modeling::Solid>(project_.body); }

  // Only with splines; otherwise they throw std::bad_optional_access.
  const modeling::SurfaceEvaluator& evaluator() const { return patches_.value().evaluator; }
  /// Per patch, as modeling::smoothingGroups().
  const std::vector<int>& smoothingGroups() const { return patches_.value().smoothingGroups; }
  /// The analysis net: fine enough for the project's touches and for fingertips everywhere.
  const SplineRefinement& refinement() const { return patches_.value().refinement; }

 private:
  struct Patches {
    modeling::SurfaceEvaluator evaluator;
    std::vector<int> smoothingGroups;
    SplineRefinement refinement;
  };

  const modeling::Project& project_;
  std::vector<modeling::MeshRegion> regions_;
  std::optional<Patches> patches_;  // with splines
};

}  // namespace palpa::app

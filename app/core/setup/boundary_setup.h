#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/core/setup/spline_refinement.h"
#include "bem/model/boundary_conditions.h"
#include "bem/model/traction_projection.h"
#include "bem/problem/discretisation.h"
#include "modeling/project/project.h"

namespace palpa::bem {
class SplineDiscretisation;
}

namespace palpa::app {

/// A project's surface, supports and loads in the terms of the boundary element method.
struct BoundarySetup {
  /// Without supports and loads.
  BoundarySetup(const modeling::Project& project,
                std::shared_ptr<const bem::Discretisation> surface);

  std::shared_ptr<const bem::Discretisation> discretisation;
  /// The same when it is one of splines, otherwise null.
  std::shared_ptr<const bem::SplineDiscretisation> splines;
  /// The solid whose control points the splines' coefficients belong to: the project's solid with
  /// knots inserted. Null without splines.
  std::shared_ptr<const modeling::Solid> splineRefinement;
  bem::Material material;
  bem::BoundaryConditions conditions;  ///< of the coefficients

  const bem::BoundaryMesh& mesh() const { return discretisation->mesh(); }
  const bem::TractionSlots& meshSlots() const { return discretisation->meshSlots(); }

  /// A support's name, and the triangles of the mesh and the elements that it acts on.
  struct Part {
    std::string name;
    std::vector<int> triangles, elements;  ///< ascending
    bool isFixed = false;                  ///< holds the whole displacement
  };
  std::vector<Part> supports;
  struct LoadPart {
    std::string name;
    Eigen::VectorXd traction;  ///< its share of conditions.traction, 3 per slot, MPa
    bem::Resultant resultant;
    Eigen::Vector3d place;  ///< mean of the places it acts on, weighted by its traction, mm
  };
  std::vector<LoadPart> loads;
  /// `traction`: 3 per slot, MPa.
  void addLoad(const std::string& name, Eigen::VectorXd traction);
};

/// Radius of a touch that does not name one, mm: that of a fingertip, but at most a fifth of the
/// body's size (the diagonal of its box, mm).
double defaultTouchRadius(double bodySize);

/// The narrowest touch that a project's model is to resolve anywhere, mm: a fingertip's, or the
/// narrowest of the project's touches when that is wider.
double fingertipRadius(const modeling::Project& project);

/// Is the project's body computed with splines? Solids are, unless the project says otherwise; mesh
/// bodies have no patches.
bool usesSplines(const modeling::Project& project);

/// The analysis net of a project whose body is a solid: fine enough for all of its touches and for
/// fingertips.
SplineRefinement splineRefinement(const modeling::Project& project);

/// Translates a meshed project (`surface` made with meshRegions(project)) for its engine. Where
/// supports and loads begin, the traction may jump. Throws SolverError (kBadCondition) when two
/// supports claim the same place or prescribe different displacements where they meet. `net`: the
/// analysis net of the project when it is known already, null: made where splines need it.
BoundarySetup makeBoundarySetup(const modeling::Project& project,
                                const modeling::SurfaceMesh& surface,
                                const SplineRefinement* net = nullptr);

}  // namespace palpa::app

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/core/setup/project_geometry.h"
#include "bem/model/boundary_conditions.h"
#include "bem/model/traction_projection.h"
#include "bem/problem/discretisation.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::bem {
class SplineDiscretisation;
}

namespace palpa::app {

/// A project's surface, supports and loads as a boundary element problem.
struct BoundarySetup {
  /// Without supports and loads.
  BoundarySetup(const modeling::Project& project,
                std::shared_ptr<const bem::Discretisation> surface);

  std::shared_ptr<const bem::Discretisation> discretisation;
  /// The same object with splines, otherwise null.
  std::shared_ptr<const bem::SplineDiscretisation> splines;
  /// The solid whose control points the splines' coefficients belong to: the project's solid with
  /// knots inserted. Null without splines.
  std::shared_ptr<const modeling::Solid> refinedSolid;
  bem::Material material;
  bem::BoundaryConditions conditions;  ///< of the coefficients

  const bem::BoundaryMesh& mesh() const { return discretisation->mesh(); }
  const bem::TractionSlots& meshSlots() const { return discretisation->meshSlots(); }

  /// A support's name, and the triangles of the mesh and the elements that it acts on.
  struct Part {
    std::string name;
    std::vector<int> triangles, elements;  ///< ascending
    bool isFixed = false;                  ///< true if it fixes the whole displacement
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

/// Translates a meshed project for its engine; `surface` is fitted to geometry.regions(). The
/// traction may jump at the borders of supports and loads. Throws SolverError (kBadCondition) if
/// two supports claim the same place or prescribe different displacements where they meet.
BoundarySetup makeBoundarySetup(const ProjectGeometry& geometry,
                                const modeling::SurfaceMesh& surface);

}  // namespace palpa::app

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
  modeling::Engine engine = modeling::Engine::kTriangles;  ///< never automatic
  /// The same object with splines, otherwise null.
  std::shared_ptr<const bem::SplineDiscretisation> splines;
  /// The solid whose control points the splines' coefficients belong to: the project's solid with
  /// knots inserted. Null without splines.
  std::shared_ptr<const modeling::Solid> refinedSolid;
  bem::Material material;
  bem::BoundaryConditions conditions;  ///< of the coefficients

  /// Inside of the body in the state of all loads.
  bem::Bulk bulk() const { return {material, conditions.bodyForce}; }

  const bem::BoundaryMesh& mesh() const { return discretisation->mesh(); }
  const bem::TractionSlots& meshSlots() const { return discretisation->meshSlots(); }

  /// A support's name, and the triangles of the mesh and the elements that it acts on. Where
  /// supports share a place, it belongs to one of them (RegionTags), so that the sum of the
  /// reactions is complete; a support may have none.
  struct Part {
    std::string name;
    std::vector<int> triangles, elements;  ///< ascending
    bool isFixed = false;                  ///< true if it fixes the whole displacement
  };
  std::vector<Part> supports;
  struct LoadPart {
    std::string name;
    /// Its share of conditions.traction, 3 per slot, MPa; zero for gravity.
    Eigen::VectorXd traction;
    bem::Resultant resultant;
    /// Mean of the places it acts on, weighted by its traction; for gravity the centroid; mm.
    Eigen::Vector3d place;
    /// Of a moment without a net force: its norm over the size of the body, N; otherwise 0.
    double couple = 0;
  };
  std::vector<LoadPart> loads;
  /// `traction`: 3 per slot, MPa.
  LoadPart& addLoad(const std::string& name, Eigen::VectorXd traction);
  /// `bodyForce`: N/mm^3.
  void addBodyForce(const std::string& name, const Eigen::Vector3d& bodyForce);
};

/// Translates a meshed project for its engine; `surface` is fitted to geometry.regions(). The
/// traction may jump at the borders of supports and loads. Throws
/// SupportConflictError if two supports prescribe different displacements at one place.
BoundarySetup makeBoundarySetup(const ProjectGeometry& geometry,
                                const modeling::SurfaceMesh& surface);

}  // namespace palpa::app

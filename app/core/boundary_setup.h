#pragma once
#include <string>
#include <vector>

#include "bem/boundary_conditions.h"
#include "bem/traction_projection.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// A project's mesh, supports and loads in the terms of the boundary element method.
struct BoundarySetup {
  bem::BoundaryMesh mesh;
  bem::TractionSlots slots;
  bem::Material material;
  bem::BoundaryConditions conditions;

  /// A support's or load's name and the triangles it acts on.
  struct Part {
    std::string name;
    std::vector<int> triangles;
  };
  std::vector<Part> supports;
  struct LoadPart {
    std::string name;
    Eigen::VectorXd traction;  ///< its share of conditions.traction, 3 per slot, MPa
    bem::Resultant resultant;
  };
  std::vector<LoadPart> loads;
};

/// Translates a meshed project (`surface` made with meshRegions(project)). Where supports and loads
/// begin, the traction may jump. Throws SolverError (kBadCondition) when two supports claim the
/// same place or prescribe different displacements where they meet.
BoundarySetup makeBoundarySetup(const modeling::Project& project,
                                const modeling::SurfaceMesh& surface);

}  // namespace palpa::app

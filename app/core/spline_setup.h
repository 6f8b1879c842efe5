#pragma once
#include <string>
#include <vector>

#include "app/core/analysis_net.h"
#include "bem/boundary_conditions.h"
#include "bem/spline/spline_mesh.h"
#include "bem/traction_projection.h"

namespace palpa::app {

/// A project's solid, supports and loads in the terms of the spline discretisation, with the mesh
/// that shows it. What BoundarySetup is for triangles.
struct SplineSetup {
  modeling::Solid solid;  ///< the project's, with the net's knots
  /// Elements have the tags of the mesh's triangles: equal ones are the same combination of
  /// regions.
  bem::SplineSurface surface;
  bem::SplineTractions tractions;
  std::vector<int> tagOfTriangle;
  std::vector<bem::SplineMesh::Triangle> triangles;
  bem::BoundaryConditions conditions;  ///< in coefficients

  /// A support's or load's name and the elements it acts on.
  struct Part {
    std::string name;
    std::vector<int> elements;
  };
  std::vector<Part> supports;
  struct LoadPart : Part {
    Eigen::VectorXd traction;  ///< its share of conditions.traction, 3 per slot, MPa
    bem::Resultant resultant;
  };
  std::vector<LoadPart> loads;
};

/// Translates a project whose body is a solid. `mesh`: made with meshRegions(project); `net`: of
/// the project.
///
/// Supports hold coefficients. A fixed one gives its displacement to all whose functions lie in it
/// (exactly, wherever its border runs: functions are torn there); one that barely reaches into it
/// stays free. A roller holds the component along the surface's normal at the function's Greville
/// point: exact on flat faces; on curved ones it slips between these by about 0.5 % of the sliding
/// with elements that turn by 22 degrees. Loads are L2-projected.
///
/// Throws SolverError (kBadCondition) as makeBoundarySetup(), ModelingError as refined().
SplineSetup makeSplineSetup(const modeling::Project& project, const modeling::SurfaceMesh& mesh,
                            const AnalysisNet& net);

}  // namespace palpa::app

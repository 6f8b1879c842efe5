#pragma once

#include "app/verification/analytic_case.h"
#include "base/job.h"

namespace palpa::verification {

enum class BoundaryData {
  kAsStated,  ///< as the case prescribes, region by region
  kMixed      ///< exact displacements on a part of the surface, exact tractions on the rest
};

/// Relative errors of a solution with triangles.
struct TriangleErrors {
  int nodes;
  double displacement;  ///< rms at the nodes, over the rms of the exact values
  double points;        ///< largest at the sample points of the file, over the largest displacement
  double traction;      ///< rms where it is unknown, over the rms of all exact tractions
  double resultant;     ///< of stated reactions, over the size of the load; 0 without one
};

/// Solves a case with about 500 nodes, elements of 4 to 5 mm.
///
/// If the conditions of the case leave a rigid motion free, the exact displacement is also
/// prescribed on a part of the surface: a cap of a sphere, a piece of a torus, a patch of the side
/// of a cylinder. Throws as AnalyticCase, and SolverError, Cancelled.
TriangleErrors solveWithTriangles(const AnalyticCase& body, BoundaryData data, const Job& job);

}  // namespace palpa::verification

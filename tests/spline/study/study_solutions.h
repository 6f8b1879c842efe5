#pragma once

#include <functional>

#include "app/verification/exact/solved_body.h"
#include "modeling/mesh/mesh.h"
#include "spline_body.h"
#include "study_series.h"

namespace palpa::bem::test {

/// Which places of the surface are held.
using HeldPlaces = std::function<bool(const Eigen::Vector3d&)>;

/// Names of the engines in tables and plots.
inline constexpr const char* kTriangles = "triangles";
inline constexpr const char* kQuadratic = "quadratic splines";
inline constexpr const char* kCubic = "cubic splines";

/// Integration tolerance of the spline engine: an order below the smallest error of the study.
inline constexpr AssemblyOptions kSplineOptions{1e-6};

/// How often solutions are repeated for their times: the environment variable PALPA_STUDY_ROUNDS,
/// or once.
int studyRounds();

/// The fastest of some equal solutions, each a pointer to something with `times`: what the machine
/// does when nobody disturbs it.
template <class Solve>
auto fastest(const Solve& solve) {
  auto best = solve();
  for (int round = 1; round < studyRounds(); ++round) {
    auto other = solve();
    if (other->times.assemble + other->times.factorise <
        best->times.assemble + best->times.factorise)
      best = std::move(other);
  }
  return best;
}

/// Solves with splines; displacements of the tag 1 and tractions elsewhere from `exact`.
std::unique_ptr<SplineBody> solveSplines(const SplineSurface& surface, const Material& material,
                                         const ExactField& exact);
/// The same with flat triangles, held where the middle of a triangle is.
std::unique_ptr<SolvedBody> solveTriangles(const BoundaryMesh& mesh, const HeldPlaces& held,
                                           const Material& material, const ExactField& exact);

/// Size, error of u against `exact` and seconds of a solution.
StudyStep stepOf(const SplineBody& body, const ExactField& exact);
StudyStep stepOf(const SolvedBody& body, const ExactField& exact);

/// Triangles with edges of this length (mm) on a solid, if asked for refined twice towards the
/// borders of the regions. The tag is k + 1 in regions[k], 0 elsewhere.
BoundaryMesh triangleMesh(const modeling::Solid& solid, double edgeLength,
                          const std::vector<modeling::MeshRegion>& regions = {},
                          bool isRefined = false);

}  // namespace palpa::bem::test

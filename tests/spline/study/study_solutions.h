#pragma once

#include <functional>

#include "app/verification/exact/solved_body.h"
#include "modeling/mesh/mesh.h"
#include "spline_body.h"
#include "study_series.h"

namespace palpa::bem::test {

/// Predicate: true for fixed points of the surface (mm).
using FixedPlaces = std::function<bool(const Eigen::Vector3d&)>;

/// Names of the engines in tables and plots.
inline constexpr const char* kTriangles = "triangles";
inline constexpr const char* kQuadratic = "quadratic splines";
inline constexpr const char* kCubic = "cubic splines";

/// Integration tolerance of the spline engine: ten times below the smallest error of the study.
inline constexpr AssemblyOptions kSplineOptions{1e-6};

/// Number of repetitions of a solution for time measurements: the environment variable
/// PALPA_STUDY_ROUNDS, or 1.
int studyRounds();

/// Fastest of several equal solutions, each a pointer to an object with `times`: the time on an
/// undisturbed machine.
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

/// Solves with splines; `exact` gives displacements for the tag 1 and tractions elsewhere.
std::unique_ptr<SplineBody> solveSplines(const SplineSurface& surface, const Material& material,
                                         const ExactField& exact);
/// Solves with flat triangles, fixed where `fixed` is true for the middle of a triangle.
std::unique_ptr<SolvedBody> solveTriangles(const BoundaryMesh& mesh, const FixedPlaces& fixed,
                                           const Material& material, const ExactField& exact);

/// Size, error of u relative to `exact`, and seconds of a solution.
StudyStep stepOf(const SplineBody& body, const ExactField& exact);
StudyStep stepOf(const SolvedBody& body, const ExactField& exact);

/// Mesh of triangles with edges of the given length (mm) on a solid, optionally refined twice
/// towards the borders of the regions. The tag is k + 1 in regions[k], 0 elsewhere.
BoundaryMesh triangleMesh(const modeling::Solid& solid, double edgeLength,
                          const std::vector<modeling::MeshRegion>& regions = {},
                          bool isRefined = false);

}  // namespace palpa::bem::test

#pragma once

#include "study_solutions.h"

namespace palpa::bem::test {

/// Block of 40 x 30 x 20 mm, fixed at z = 0. The opposite face is loaded by a traction that
/// vanishes with its slope at the edges of that face. The stress is singular along the rim of the
/// fixed face.
struct ClampedBlock {
  Eigen::Vector3d size{40, 30, 20};
  Material material{0.1, 0.3};
  Eigen::Vector3d peak{0.002, 0.001, -0.004};  ///< MPa, in the middle of the loaded face

  /// Displacement (zero) of the fixed face and tractions of all other faces, as of an exact field.
  ExactField given() const;
  Eigen::Vector3d load() const;  ///< N, the exact resultant

  /// Spline surface with `spans` knot spans along each edge. Their lengths are proportional to
  /// i^grading - (i - 1)^grading and decrease towards the edges of the fixed face; grading 1:
  /// uniform.
  SplineSurface splines(int degree, int spans, double grading) const;
  modeling::Solid solid(int degree, int spans, double grading) const;

  std::unique_ptr<SplineBody> solve(int degree, int spans, double grading) const;
  /// Solves with triangles, uniform or refined twice towards the rim of the fixed face.
  std::unique_ptr<SolvedBody> solve(double edgeLength, bool isRefined) const;
};

/// Displacement of a solved block at the points of its surface, as a reference for other solutions;
/// its stress is set to zero.
ExactField fieldOf(std::shared_ptr<const SplineBody> block);

}  // namespace palpa::bem::test

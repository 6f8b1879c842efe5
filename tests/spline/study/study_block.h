#pragma once

#include "study_solutions.h"

namespace palpa::bem::test {

/// A block of 40 x 30 x 20 mm, held at z = 0, pulled and pushed at its opposite face by a traction
/// that vanishes with its slope at the edges of that face. The stress is singular along the rim of
/// the held face.
struct ClampedBlock {
  Eigen::Vector3d size{40, 30, 20};
  Material material{0.1, 0.3};
  Eigen::Vector3d peak{0.002, 0.001, -0.004};  ///< MPa, in the middle of the loaded face

  /// Displacement (zero) of the held face and tractions of all others, as of an exact field.
  ExactField given() const;
  Eigen::Vector3d load() const;  ///< N, the exact resultant

  /// `spans` knot spans along each edge, of lengths that fall like the powers i^grading - (i -
  /// 1)^grading towards the edges of the held face; 1: uniform.
  SplineSurface splines(int degree, int spans, double grading) const;
  modeling::Solid solid(int degree, int spans, double grading) const;

  std::unique_ptr<SplineBody> solve(int degree, int spans, double grading) const;
  /// With triangles, uniform or refined twice towards the rim of the held face.
  std::unique_ptr<SolvedBody> solve(double edgeLength, bool isRefined) const;
};

/// The displacement of a solved block at the places of its surface, to compare others with: the
/// stress is not that of the solution but zero.
ExactField fieldOf(std::shared_ptr<const SplineBody> block);

}  // namespace palpa::bem::test

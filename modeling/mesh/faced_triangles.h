#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace palpa::modeling {

/// Flat triangles that know the face of a body they belong to.
struct FacedTriangles {
  std::vector<Eigen::Vector3d> positions;     ///< mm
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<int> faceOfTriangle;            ///< face of the body, one per triangle
};

}  // namespace palpa::modeling

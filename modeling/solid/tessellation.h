#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Triangles over the patches of a solid for drawing while control points move: fixed parameters,
/// so that a new shape is three products of a sparse matrix with the control points (about 2 ms for
/// 10,000 vertices). Each patch has vertices of its own: normals may jump between patches.
///
/// Immutable; const use from several threads is safe.
class Tessellation {
 public:
  /// `piecesPerSpan`: 1 … 32 pieces per polynomial span and direction.
  explicit Tessellation(const Solid& solid, int piecesPerSpan = 6);

  struct Shape {
    std::vector<Eigen::Vector3d> positions;  ///< mm
    std::vector<Eigen::Vector3d> normals;    ///< unit, outwards; zero where the patch is degenerate
  };

  /// The shape for the control points of the solid it was made from, or others in their place.
  Shape evaluate(const std::vector<Eigen::Vector3d>& controlPoints) const;

  int vertexCount() const { return static_cast<int>(position_.rows()); }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<int>& patchOfTriangle() const { return patchOfTriangle_; }

  /// The parameters (u, v) of each vertex in its patch.
  const std::vector<Eigen::Vector2d>& parameters() const { return parameters_; }

  /// Vertices along the four sides of each patch, in order of growing parameter: the solid's edges.
  const std::vector<std::vector<int>>& borders() const { return borders_; }
  /// Vertices along the lines of constant parameter at interior knots.
  const std::vector<std::vector<int>>& knotLines() const { return knotLines_; }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> position_, du_, dv_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<int> patchOfTriangle_;
  std::vector<Eigen::Vector2d> parameters_;
  std::vector<std::vector<int>> borders_;
  std::vector<std::vector<int>> knotLines_;
};

/// The lines of the control nets: pairs of neighbouring control points, each once, in order.
std::vector<std::array<int, 2>> controlNetLines(const Solid& solid);

}  // namespace palpa::modeling

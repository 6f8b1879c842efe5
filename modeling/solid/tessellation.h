#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Triangulation of the patches of a solid for drawing while control points move. The parameters of
/// the vertices are fixed, so a new shape is three products of a sparse matrix with the control
/// points (about 2 ms for 10,000 vertices). Each patch has separate vertices: normals may jump
/// between patches.
///
/// Immutable; const use from several threads is safe.
class Tessellation {
 public:
  /// `piecesPerSpan`: 1 … 32 pieces per polynomial span and direction. Throws std::invalid_argument
  /// if it is out of range.
  explicit Tessellation(const Solid& solid, int piecesPerSpan = 6);

  /// Vertex data, one entry per vertex.
  struct Shape {
    std::vector<Eigen::Vector3d> positions;  ///< mm
    std::vector<Eigen::Vector3d> normals;    ///< unit, outwards; zero where the patch is degenerate
  };

  /// Shape for the control points of the original solid, or for other positions (mm) of them.
  /// Throws std::invalid_argument if the number of points differs.
  Shape evaluate(const std::vector<Eigen::Vector3d>& controlPoints) const;

  int vertexCount() const { return static_cast<int>(position_.rows()); }
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }
  const std::vector<int>& patchOfTriangle() const { return patchOfTriangle_; }

  /// Parameters (u, v) of each vertex in its patch.
  const std::vector<Eigen::Vector2d>& parameters() const { return parameters_; }

  /// Vertices along the four sides of each patch in the order of the growing parameter: the edges
  /// of the solid.
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

/// Lines of the control nets: pairs of adjacent control points, each once, in ascending order.
std::vector<std::array<int, 2>> controlNetLines(const Solid& solid);

}  // namespace palpa::modeling

#include "modeling/solid/tessellation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <stdexcept>

#include "modeling/solid/basis.h"

namespace palpa::modeling {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Parameters of the vertices along one direction, with the basis there.
struct Direction {
  std::vector<double> parameters;
  std::vector<BasisFunctions> position;  // at the parameter itself
  std::vector<BasisFunctions> slope;     // where the derivative is evaluated
  std::vector<int> knotVertices;
};

Direction sample(const Patch& patch, int direction, int piecesPerSpan) {
  const std::vector<double>& knots = patch.knots[direction];
  const double low = knots.front();
  const double high = knots.back();
  // Derivatives are evaluated slightly inside: in the corners of a round cap du and dv are
  // parallel, and on a border between spans the inner span counts.
  const auto inside = [&](double t) { return t + 0.01 * (0.5 * (low + high) - t); };
  Direction result;
  const auto add = [&](double t) {
    result.parameters.push_back(t);
    result.position.push_back(basisAt(knots, patch.degree[direction], t));
    result.slope.push_back(basisAt(knots, patch.degree[direction], inside(t)));
  };
  add(low);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] == knots[i - 1]) continue;
    for (int k = 1; k <= piecesPerSpan; ++k)
      add(k == piecesPerSpan
              ? knots[i]
              : knots[i - 1] + (knots[i] - knots[i - 1]) * k / static_cast<double>(piecesPerSpan));
    if (knots[i] < high)
      result.knotVertices.push_back(static_cast<int>(result.position.size()) - 1);
  }
  return result;
}

using Values = std::array<double, kMaxDegree + 1>;

/// Appends one row: the tensor product of two sets of basis values.
void addRow(int row, const Patch& patch, int uFirst, const Values& u, int vFirst, const Values& v,
            Triplets& triplets) {
  for (int i = 0; i <= patch.degree[0]; ++i)
    for (int j = 0; j <= patch.degree[1]; ++j)
      triplets.emplace_back(row, patch.net[uFirst + i][vFirst + j], u[i] * v[j]);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(int rows, std::size_t columns,
                                                    const Triplets& triplets) {
  Eigen::SparseMatrix<double, Eigen::RowMajor> result(rows, static_cast<Eigen::Index>(columns));
  result.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

}  // namespace

Tessellation::Tessellation(const Solid& solid, int piecesPerSpan) {
  if (piecesPerSpan < 1 || piecesPerSpan > 32)
    throw std::invalid_argument("Tessellation: 1 … 32 pieces per span are possible");
  Triplets position, du, dv;
  int vertices = 0;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    const Patch& patch = solid.patches()[p];
    const Direction u = sample(patch, 0, piecesPerSpan);
    const Direction v = sample(patch, 1, piecesPerSpan);
    const int rows = static_cast<int>(u.position.size());
    const int columns = static_cast<int>(v.position.size());
    const auto vertex = [&](int i, int j) { return vertices + i * columns + j; };
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const int row = vertex(i, j);
        parameters_.emplace_back(u.parameters[i], v.parameters[j]);
        const BasisFunctions& a = u.position[i];
        const BasisFunctions& b = v.position[j];
        addRow(row, patch, a.first, a.value, b.first, b.value, position);
        const BasisFunctions& c = u.slope[i];
        const BasisFunctions& d = v.slope[j];
        addRow(row, patch, c.first, c.derivative, d.first, d.value, du);
        addRow(row, patch, c.first, c.value, d.first, d.derivative, dv);
      }
    for (int i = 0; i + 1 < rows; ++i)
      for (int j = 0; j + 1 < columns; ++j) {
        triangles_.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        triangles_.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    patchOfTriangle_.resize(triangles_.size(), static_cast<int>(p));
    const auto alongU = [&](int j) {
      std::vector<int> line;
      for (int i = 0; i < rows; ++i) line.push_back(vertex(i, j));
      return line;
    };
    const auto alongV = [&](int i) {
      std::vector<int> line;
      for (int j = 0; j < columns; ++j) line.push_back(vertex(i, j));
      return line;
    };
    borders_.insert(borders_.end(), {alongU(0), alongV(rows - 1), alongU(columns - 1), alongV(0)});
    for (int i : u.knotVertices) knotLines_.push_back(alongV(i));
    for (int j : v.knotVertices) knotLines_.push_back(alongU(j));
    vertices += rows * columns;
  }
  const std::size_t points = solid.controlPoints().size();
  position_ = matrix(vertices, points, position);
  du_ = matrix(vertices, points, du);
  dv_ = matrix(vertices, points, dv);
}

Tessellation::Shape Tessellation::evaluate(
    const std::vector<Eigen::Vector3d>& controlPoints) const {
  if (static_cast<Eigen::Index>(controlPoints.size()) != position_.cols())
    throw std::invalid_argument("Tessellation: the number of control points differs");
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Map<const Points> points(controlPoints.front().data(), position_.cols(), 3);
  const Points positions = position_ * points;
  const Points du = du_ * points;
  const Points dv = dv_ * points;
  Shape shape;
  shape.positions.resize(positions.rows());
  shape.normals.resize(positions.rows());
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    shape.positions[i] = positions.row(i).transpose();
    const Eigen::Vector3d cross =
        Eigen::Vector3d(du.row(i).transpose()).cross(Eigen::Vector3d(dv.row(i).transpose()));
    const double length = cross.norm();
    shape.normals[i] = length > 0.0 ? Eigen::Vector3d(cross / length) : Eigen::Vector3d::Zero();
  }
  return shape;
}

std::vector<std::array<int, 2>> controlNetLines(const Solid& solid) {
  std::set<std::array<int, 2>> lines;
  const auto add = [&](int a, int b) {
    if (a != b) lines.insert({std::min(a, b), std::max(a, b)});
  };
  for (const Patch& patch : solid.patches())
    for (std::size_t i = 0; i < patch.net.size(); ++i)
      for (std::size_t j = 0; j < patch.net[i].size(); ++j) {
        if (i > 0) add(patch.net[i - 1][j], patch.net[i][j]);
        if (j > 0) add(patch.net[i][j - 1], patch.net[i][j]);
      }
  return {lines.begin(), lines.end()};
}

}  // namespace palpa::modeling

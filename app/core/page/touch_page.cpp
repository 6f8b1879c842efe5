#include "app/core/page/touch_page.h"

#include <cmath>

namespace palpa::app {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Adds the values at the corners, edges and middle of a point's triangle, each times its weight:
/// quadratic functions and a cubic bubble that gives the right value at the middle.
template <class Sum, class Value, class ValueOf>
Sum interpolate(const TouchPage& page, const TouchPage::Point& point, Sum sum,
                const std::vector<Value>& atVertices, const std::vector<Value>& atEdges,
                const std::vector<Value>& atMiddles, const ValueOf& valueOf) {
  const auto triangle = static_cast<std::size_t>(point.triangle);
  const Vector3d& w = point.weights;
  const double bubble = 27 * w.prod();
  // The quadratic functions have the values -1/9 (corners) and 4/9 (edges) at the middle.
  sum += bubble * valueOf(atMiddles[triangle]);
  for (Index k = 0; k < 3; ++k) {
    const auto corner = static_cast<std::size_t>(k);
    sum += (w[k] * (2 * w[k] - 1) + bubble / 9) *
           valueOf(atVertices[page.triangles[triangle][corner]]);
    sum += 4 * (w[(k + 1) % 3] * w[(k + 2) % 3] - bubble / 9) *
           valueOf(atEdges[page.edges[triangle][corner]]);
  }
  return sum;
}

}  // namespace

void QuantisedColumns::add(const Eigen::VectorXd& column) {
  constexpr double kLargest = 32767;
  rows = static_cast<int>(column.size());
  const double largest = column.size() > 0 ? column.cwiseAbs().maxCoeff() : 0;
  // Rounding up the scale to single precision must not make a number larger than 16 bits.
  const auto scale = static_cast<float>(largest / kLargest * (1 + 1e-6));
  scales.push_back(scale);
  for (const double value : column)
    numbers.push_back(static_cast<std::int16_t>(scale > 0 ? std::lround(value / scale) : 0));
}

Vector3d TouchPage::positionOf(const Point& point) const {
  Vector3d sum = Vector3d::Zero();
  const auto& corners = triangles[static_cast<std::size_t>(point.triangle)];
  for (std::size_t k = 0; k < 3; ++k)
    sum += point.weights[static_cast<Index>(k)] * positions[corners[k]].cast<double>();
  return sum;
}

Vector3d TouchPage::normalOf(const Point& point) const {
  Vector3d sum = Vector3d::Zero();
  const auto& corners = triangles[static_cast<std::size_t>(point.triangle)];
  for (std::size_t k = 0; k < 3; ++k)
    sum += point.weights[static_cast<Index>(k)] * normals[corners[k]].cast<double>();
  return sum.normalized();
}

Vector3d TouchPage::loadedAt(const Point& point) const {
  return interpolate(*this, point, Vector3d(Vector3d::Zero()), meanLoaded, meanLoadedAtEdges,
                     meanLoadedAtMiddles,
                     [](const Eigen::Vector3f& value) -> Vector3d { return value.cast<double>(); });
}

Matrix3d TouchPage::symmetric(const std::array<float, 6>& numbers) {
  const auto& [xx, yy, zz, xy, xz, yz] = numbers;
  Eigen::Matrix3f matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return matrix.cast<double>();
}

Matrix3d TouchPage::ownCompliance(const Point& point) const {
  return interpolate(*this, point, Matrix3d(Matrix3d::Zero()), own, ownAtEdges, ownAtMiddles,
                     &TouchPage::symmetric);
}

std::map<int, Matrix3d> TouchPage::placesAt(const Point& point) const {
  std::map<int, Matrix3d> result;
  const auto& corners = triangles[static_cast<std::size_t>(point.triangle)];
  for (std::size_t k = 0; k < 3; ++k) {
    const PlaceWeights& from = weights[corners[k]];
    for (std::size_t i = 0; i < PlaceWeights::kCount; ++i)
      result.try_emplace(from.places[i], Matrix3d::Zero()).first->second +=
          point.weights[static_cast<Index>(k)] * from.at(i);
  }
  return result;
}

Matrix3d TouchPage::couplingOf(const Point& a, const Point& b) const {
  Matrix3d sum = Matrix3d::Zero();
  const auto atB = placesAt(b);
  for (const auto& [i, weightA] : placesAt(a)) {
    Matrix3d moved = Matrix3d::Zero();  // of the place i, by the force at b
    for (const auto& [j, weightB] : atB) {
      Matrix3d block;
      for (Index column = 0; column < 3; ++column)
        for (Index row = 0; row < 3; ++row)
          block(row, column) =
              coupling.at(3 * static_cast<Index>(i) + row, 3 * static_cast<Index>(j) + column);
      moved += block * weightB;
    }
    sum += weightA.transpose() * moved;
  }
  return sum;
}

Eigen::MatrixX3d TouchPage::fieldOf(const Point& point) const {
  Eigen::MatrixX3d atNodes = Eigen::MatrixX3d::Zero(3 * static_cast<Index>(nodeCount), 3);
  for (const auto& [j, weight] : placesAt(point))
    for (Index axis = 0; axis < 3; ++axis) {
      const Index column = 3 * static_cast<Index>(j) + axis;
      const auto numbers = Eigen::Map<const Eigen::Matrix<std::int16_t, Eigen::Dynamic, 1>>(
          fields.numbers.data() + column * fields.rows, fields.rows);
      const double scale = fields.scales[static_cast<std::size_t>(column)];
      atNodes += numbers.cast<double>() * (scale * weight.row(axis));
    }
  Eigen::MatrixX3d field = Eigen::MatrixX3d::Zero(3 * static_cast<Index>(positions.size()), 3);
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      field.middleRows<3>(3 * static_cast<Index>(v)) +=
          nodeWeights[v][k] * atNodes.middleRows<3>(3 * static_cast<Index>(nodes[v][k]));
  return field;
}

std::size_t TouchPage::couplingClass(const Vector3d& a, const Vector3d& b) const {
  const double distance = (a - b).norm() / radius;
  std::size_t found = 0;
  while (found < kCouplingDistances.size() && distance >= kCouplingDistances[found]) ++found;
  return found;
}

std::vector<Vector3d> TouchPage::forces(std::span<const Point> points,
                                        std::span<const Vector3d> displacements) const {
  const auto count = static_cast<Index>(points.size());
  Eigen::MatrixXd compliance(3 * count, 3 * count);
  Eigen::VectorXd rise(3 * count);
  for (Index a = 0; a < count; ++a) {
    const auto& pointA = points[static_cast<std::size_t>(a)];
    rise.segment<3>(3 * a) = displacements[static_cast<std::size_t>(a)] - loadedAt(pointA);
    for (Index b = 0; b < count; ++b)
      compliance.block<3, 3>(3 * a, 3 * b) =
          a == b ? ownCompliance(pointA) : couplingOf(pointA, points[static_cast<std::size_t>(b)]);
  }
  const Eigen::VectorXd solution = compliance.ldlt().solve(rise);
  std::vector<Vector3d> result;
  for (Index a = 0; a < count; ++a) result.emplace_back(solution.segment<3>(3 * a));
  return result;
}

}  // namespace palpa::app

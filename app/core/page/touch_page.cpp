#include "app/core/page/touch_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::app {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

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
  Vector3d sum = Vector3d::Zero();
  const auto& corners = triangles[static_cast<std::size_t>(point.triangle)];
  for (std::size_t k = 0; k < 3; ++k)
    sum += point.weights[static_cast<Index>(k)] * meanLoaded[corners[k]].cast<double>();
  return sum;
}

Matrix3d TouchPage::symmetric(const std::array<float, 6>& numbers) {
  const auto& [xx, yy, zz, xy, xz, yz] = numbers;
  Eigen::Matrix3f matrix;
  matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return matrix.cast<double>();
}

Matrix3d TouchPage::ownCompliance(const Point& point) const {
  const auto triangle = static_cast<std::size_t>(point.triangle);
  const double bubble = 27 * point.weights.prod();
  Matrix3d sum = bubble * symmetric(ownAtMiddles[triangle]);
  for (std::size_t k = 0; k < 3; ++k)
    sum += (point.weights[static_cast<Index>(k)] - bubble / 3) *
           symmetric(own[triangles[triangle][k]]);
  return sum;
}

Matrix3d TouchPage::kernel(const Vector3d& normal, double distance, double core) const {
  const double nu = material.poissonRatio;
  const double size = 1 / (2 * std::numbers::pi * material.shear() * std::hypot(distance, core));
  return size * ((1 - nu / 2) * Matrix3d::Identity() - nu / 2 * normal * normal.transpose());
}

Matrix3d TouchPage::meanKernel(const Vector3d& a, const Vector3d& normalA, const Vector3d& b,
                               const Vector3d& normalB) const {
  const double distance = (a - b).norm();
  return 0.5 *
         (kernel(normalA, distance, coreOfMeans()) + kernel(normalB, distance, coreOfMeans()));
}

std::vector<std::pair<int, double>> TouchPage::placesAt(const Point& point) const {
  std::vector<std::pair<int, double>> result;
  const auto& corners = triangles[static_cast<std::size_t>(point.triangle)];
  for (std::size_t k = 0; k < 3; ++k) {
    const PlaceWeights& from = weights[corners[k]];
    for (std::size_t i = 0; i < PlaceWeights::kCount; ++i) {
      const double weight = point.weights[static_cast<Index>(k)] * from.weights[i];
      if (weight == 0) continue;
      const auto found = std::find_if(result.begin(), result.end(), [&](const auto& each) {
        return each.first == from.places[i];
      });
      if (found == result.end())
        result.emplace_back(from.places[i], weight);
      else
        found->second += weight;
    }
  }
  return result;
}

Matrix3d TouchPage::couplingOf(const Point& a, const Point& b) const {
  Matrix3d sum = meanKernel(positionOf(a), normalOf(a), positionOf(b), normalOf(b));
  const auto atA = placesAt(a), atB = placesAt(b);
  for (const auto& [j, weightB] : atB)
    for (const auto& [i, weightA] : atA)
      for (Index column = 0; column < 3; ++column)
        for (Index row = 0; row < 3; ++row)
          sum(row, column) +=
              weightA * weightB *
              coupling.at(3 * static_cast<Index>(i) + row, 3 * static_cast<Index>(j) + column);
  return sum;
}

Matrix3d TouchPage::fieldAt(std::size_t vertex, const Point& point) const {
  if (isHeld[vertex]) return Matrix3d::Zero();
  const Vector3d at = positions[vertex].cast<double>();
  Matrix3d sum = kernel(normalOf(point), (at - positionOf(point)).norm(), coreAtPoints());
  for (const auto& [j, weight] : placesAt(point))
    for (std::size_t k = 0; k < 3; ++k)
      for (Index column = 0; column < 3; ++column)
        for (Index row = 0; row < 3; ++row)
          sum(row, column) += weight * nodeWeights[vertex][k] *
                              fields.at(3 * static_cast<Index>(nodes[vertex][k]) + row,
                                        3 * static_cast<Index>(j) + column);
  return sum;
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

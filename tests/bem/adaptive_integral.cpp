#include "adaptive_integral.h"

#include <functional>
#include <numbers>
#include <vector>

#include "bem/triangle/kelvin.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Gauss-Legendre on [0, 1] by Newton's iteration on the Legendre polynomial.
struct GaussRule {
  std::vector<double> point, weight;
  explicit GaussRule(int n) : point(n), weight(n) {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int iteration = 0; iteration < 20; ++iteration) {
        double p = 1, previous = 0;
        for (int k = 1; k <= n; ++k) {
          const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
          previous = p;
          p = next;
        }
        slope = n * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      point[i] = (1 + x) / 2;
      weight[i] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

const GaussRule& gauss() {
  static const GaussRule rule(10);
  return rule;
}

/// Calls visit(barycentric weights, area weight) for pieces of the triangle that are small compared
/// with their distance from x. Pieces below `smallest` times the triangle's size are omitted.
void visitPieces(const Corners& corners, const Matrix3d& cell, const Vector3d& x, double smallest,
                 const std::function<void(const Vector3d&, double)>& visit) {
  constexpr double kFar = 3.0;
  Matrix3d positions;
  positions << corners[0], corners[1], corners[2];
  const Matrix3d p = positions * cell;
  const Vector3d centroid = p.rowwise().mean();
  const double radius = (p.colwise() - centroid).colwise().norm().maxCoeff();
  if ((centroid - x).norm() < kFar * radius) {
    if (radius < smallest) return;
    int longest = 0;
    double length = 0;
    for (int k = 0; k < 3; ++k)
      if (const double l = (p.col((k + 1) % 3) - p.col(k)).norm(); l > length) {
        length = l;
        longest = k;
      }
    const Vector3d middle = (cell.col(longest) + cell.col((longest + 1) % 3)) / 2;
    for (const int replaced : {longest, (longest + 1) % 3}) {
      Matrix3d half = cell;
      half.col(replaced) = middle;
      visitPieces(corners, half, x, smallest, visit);
    }
    return;
  }
  const double area = (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0)).norm();
  const GaussRule& rule = gauss();
  for (std::size_t i = 0; i < rule.point.size(); ++i)
    for (std::size_t j = 0; j < rule.point.size(); ++j) {
      const double s = rule.point[i], t = rule.point[j];
      visit(cell * Vector3d(1 - s, s * (1 - t), s * t), area * s * rule.weight[i] * rule.weight[j]);
    }
}

double sizeOf(const Corners& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

Vector3d positionOf(const Corners& c, const Vector3d& weights) {
  return weights[0] * c[0] + weights[1] * c[1] + weights[2] * c[2];
}

/// PV ∫ r/R^3 over the triangle for x inside it; each edge is bisected towards x.
Vector3d principalValue(const Corners& corners, const Vector3d& x, const Vector3d& normal) {
  Vector3d sum = Vector3d::Zero();
  const GaussRule& rule = gauss();
  const std::function<void(const Vector3d&, const Vector3d&)> edge = [&](const Vector3d& a,
                                                                         const Vector3d& b) {
    const double length = (b - a).norm();
    if (((a + b) / 2 - x).norm() < 2 * length) {
      edge(a, (a + b) / 2);
      edge((a + b) / 2, b);
      return;
    }
    const Vector3d outward = (b - a).cross(normal) / length;
    for (std::size_t i = 0; i < rule.point.size(); ++i)
      sum -= length * rule.weight[i] / (a + rule.point[i] * (b - a) - x).norm() * outward;
  };
  for (int k = 0; k < 3; ++k) edge(corners[k], corners[(k + 1) % 3]);
  return sum;
}

}  // namespace

ElementBlocks integrateAdaptively(const Corners& corners, const Vector3d& x,
                                  const Material& material) {
  ElementBlocks blocks;
  for (int a = 0; a < 3; ++a) blocks.U[a] = blocks.T[a] = Matrix3d::Zero();
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  visitPieces(corners, Matrix3d::Identity(), x, 1e-12 * sizeOf(corners),
              [&](const Vector3d& weights, double area) {
                const Vector3d y = positionOf(corners, weights);
                const Matrix3d U = area * kelvinDisplacement(x, y, material);
                const Matrix3d T = area * kelvinTraction(x, y, normal, material);
                for (int a = 0; a < 3; ++a) {
                  blocks.U[a] += weights[a] * U;
                  blocks.T[a] += weights[a] * T;
                }
              });
  return blocks;
}

ElementBlocks integrateInPlace(const Corners& corners, const Vector3d& x,
                               const Material& material) {
  const double nu = material.poissonRatio;
  const Vector3d cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Vector3d normal = cross.normalized();
  Vector3d here;
  for (int a = 0; a < 3; ++a)
    here[a] =
        (corners[(a + 2) % 3] - corners[(a + 1) % 3]).cross(x - corners[(a + 1) % 3]).dot(cross) /
        cross.squaredNorm();
  ElementBlocks blocks;
  const Vector3d constantPart = principalValue(corners, x, normal);
  Vector3d moment[3];
  for (int a = 0; a < 3; ++a) {
    blocks.U[a] = Matrix3d::Zero();
    moment[a] = here[a] * constantPart;
  }
  visitPieces(corners, Matrix3d::Identity(), x, 1e-12 * sizeOf(corners),
              [&](const Vector3d& weights, double area) {
                const Vector3d r = positionOf(corners, weights) - x;
                const Matrix3d U = area * kelvinDisplacement(x, x + r, material);
                for (int a = 0; a < 3; ++a) {
                  blocks.U[a] += weights[a] * U;
                  moment[a] += area * (weights[a] - here[a]) / std::pow(r.norm(), 3) * r;
                }
              });
  for (int a = 0; a < 3; ++a)
    blocks.T[a] = (1 - 2 * nu) / (8 * std::numbers::pi * (1 - nu)) *
                  (moment[a] * normal.transpose() - normal * moment[a].transpose());
  return blocks;
}

}  // namespace palpa::bem::test

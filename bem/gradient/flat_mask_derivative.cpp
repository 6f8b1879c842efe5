#include "bem/gradient/flat_mask_derivative.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bem/base/triangle_rule.h"
#include "bem/gradient/recovery_derivative.h"
#include "bem/model/displacement_recovery.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// As TriangleContactSurface.
constexpr double kFade = 0.002;
constexpr double kMaxFading = 1e9;
constexpr double kCell = 0.25;

/// Cells of a triangle along each edge.
int cellsOf(const BoundaryMesh& mesh, int triangle, double radius) {
  double longest = 0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, (mesh.nodes[mesh.triangles[triangle][(k + 1) % 3]] -
                                 mesh.nodes[mesh.triangles[triangle][k]])
                                    .norm());
  return static_cast<int>(std::clamp(std::ceil(longest / (kCell * radius)), 1.0, 32.0));
}

struct Point {
  int triangle;
  Vector3d weights;   ///< barycentric coordinates
  Vector3d position;  ///< mm
  double area;        ///< mm^2
  double height;      ///< 1 - (ρ / radius)^2, at least 0
  double mean;        ///< h·u
};

class FlatMask {
 public:
  FlatMask(const BoundaryMesh& mesh, const ContactMask& mask) : mesh_(mesh) {
    for (const int node : mask.nodes)
      indexOf_.try_emplace(node, static_cast<Index>(indexOf_.size()));
  }
  Index count() const { return static_cast<Index>(indexOf_.size()); }
  std::array<Index, 3> indices(int triangle) const {
    std::array<Index, 3> result{};
    for (int a = 0; a < 3; ++a) {
      const auto found = indexOf_.find(mesh_.triangles[triangle][a]);
      result[a] = found == indexOf_.end() ? -1 : found->second;
    }
    return result;
  }
  bool isBelow(int triangle) const {
    const auto own = indices(triangle);
    return std::any_of(own.begin(), own.end(), [](Index k) { return k >= 0; });
  }
  /// Σ_a N_a c_a at a point.
  double at(const Point& point, const VectorXd& ofNodes) const {
    const auto own = indices(point.triangle);
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      if (own[a] >= 0) sum += point.weights[a] * ofNodes[own[a]];
    return sum;
  }

 private:
  const BoundaryMesh& mesh_;
  std::map<int, Index> indexOf_;
};

/// `values`: h·u at the nodes.
std::vector<Point> pointsBelow(const BoundaryMesh& mesh, const DisplacementRecovery& recovery,
                               const ContactMask& mask, const FlatMask& below,
                               const VectorXd& values) {
  std::vector<Point> points;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    if (!below.isBelow(t)) continue;
    std::array<double, 3> corner{}, bulge{};
    for (int a = 0; a < 3; ++a) {
      corner[a] = values[mesh.triangles[t][a]];
      for (const auto& [node, weight] : recovery.bulge(t, a)) bulge[a] += weight * values[node];
    }
    const int cells = cellsOf(mesh, t, mask.radius);
    const double area = mesh.area(t) / (cells * cells);
    const auto visitCell = [&](double i, double j, double sign) {
      for (const TrianglePoint& q : triangleRule7()) {
        const double v = (i + sign * q.barycentric[1]) / cells,
                     w = (j + sign * q.barycentric[2]) / cells;
        Point point{t, Vector3d(1 - v - w, v, w), {}, q.weight * area, 0, 0};
        point.position = mesh.point(t, point.weights);
        point.height = std::max(0.0, 1 - (point.position - mask.point.position).squaredNorm() /
                                             (mask.radius * mask.radius));
        for (int a = 0; a < 3; ++a)
          point.mean += point.weights[a] * corner[a] +
                        point.weights[a] * point.weights[(a + 1) % 3] * bulge[a];
        points.push_back(point);
      }
    };
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        visitCell(i, j, 1);
        if (i + j + 1 < cells) visitCell(i + 1, j + 1, -1);
      }
  }
  return points;
}

}  // namespace

// φ solves (M + F) φ = R, R_a = ∫ N_a b, F_a = m_a min((kFade m_a / R_a)², max), m_a = ∫ N_a. With
// J and G as in maskDerivative() and η = (M + F)⁻¹ G,
//   dJ = η·dR - η·(dM + dF) φ + Σ δW Φ (h·u - J) / c + Σ W Φ δ(h·u) / c,  dF_a / F_a = 3 dm_a / m_a
//   - 2 dR_a / R_a.
Matrix3Xd flatMaskDerivative(const BoundaryMesh& mesh, const TractionSlots& slots,
                             const ContactMask& mask, const MaskWork& work, const VectorXd& u) {
  const FlatMask below(mesh, mask);
  const Index count = below.count();
  const DisplacementRecovery recovery(mesh, slots);
  const VectorXd values = u.reshaped(3, u.size() / 3).transpose() * work.ofMean;
  const std::vector<Point> points = pointsBelow(mesh, recovery, mask, below, values);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  VectorXd right = VectorXd::Zero(count), integrals = right, means = right;
  for (const Point& point : points) {
    const auto own = below.indices(point.triangle);
    for (int a = 0; a < 3; ++a) {
      if (own[a] < 0) continue;
      const double weight = point.area * point.weights[a];
      right[own[a]] += weight * point.height * point.height;
      integrals[own[a]] += weight;
      means[own[a]] += weight * point.mean;
      for (int b = 0; b < 3; ++b)
        if (own[b] >= 0) system(own[a], own[b]) += weight * point.weights[b];
    }
  }
  VectorXd fading(count);
  std::vector<bool> isCapped(static_cast<std::size_t>(count));
  for (Index a = 0; a < count; ++a) {
    const double ratio = kFade * integrals[a] / std::max(right[a], 1e-300);
    isCapped[static_cast<std::size_t>(a)] = ratio * ratio >= kMaxFading;
    fading[a] = integrals[a] * std::min(ratio * ratio, kMaxFading);
  }
  system.diagonal() += fading;
  const Eigen::LDLT<Eigen::MatrixXd> factors(system);
  const VectorXd raw = factors.solve(right);
  const double carried = raw.dot(integrals);
  const double value = (raw.dot(work.ofTraction) + raw.dot(means)) / carried;
  const VectorXd adjoint = factors.solve((work.ofTraction + means - value * integrals) / carried);
  VectorXd byRight = adjoint, byIntegral(count);
  for (Index a = 0; a < count; ++a) {
    const double faded = adjoint[a] * raw[a] * fading[a];
    const bool capped = isCapped[static_cast<std::size_t>(a)];
    byIntegral[a] = -(capped ? 1 : 3) * faded / integrals[a];
    if (!capped) byRight[a] += 2 * faded / right[a];
  }

  BulgeWeights ofBulges(static_cast<std::size_t>(mesh.triangleCount()), {0, 0, 0});
  for (const Point& point : points)
    for (int a = 0; a < 3; ++a)
      ofBulges[static_cast<std::size_t>(point.triangle)][a] += point.area * below.at(point, raw) *
                                                               point.weights[a] *
                                                               point.weights[(a + 1) % 3] / carried;
  Matrix3Xd result = bulgeDerivative(mesh, slots, recovery, values, ofBulges);
  Vector3d ofCentre = Vector3d::Zero();
  for (const Point& point : points) {
    const auto& corners = mesh.triangles[point.triangle];
    const double bump = point.height * point.height, toRight = below.at(point, byRight),
                 traction = below.at(point, raw);
    const Vector3d pull = -4 * point.height / (mask.radius * mask.radius) * point.area * toRight *
                          (point.position - mask.point.position);
    const double byArea = bump * toRight - traction * below.at(point, adjoint) +
                          below.at(point, byIntegral) + traction * (point.mean - value) / carried;
    const Vector3d area = 2 * mesh.areaVector(point.triangle);
    ofCentre -= pull;
    for (int a = 0; a < 3; ++a) {
      const Vector3d opposite = mesh.nodes[corners[(a + 2) % 3]] - mesh.nodes[corners[(a + 1) % 3]];
      const Vector3d slope = area.cross(opposite) / area.squaredNorm();
      result.col(corners[a]) += point.weights[a] * pull + byArea * point.area * slope;
    }
  }
  for (int a = 0; a < 3; ++a)
    result.col(mesh.triangles[mask.point.triangle][a]) += mask.point.weights[a] * ofCentre;
  return result;
}

}  // namespace palpa::bem

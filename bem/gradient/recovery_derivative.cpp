#include "bem/gradient/recovery_derivative.h"

#include <map>

namespace palpa::bem {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// A triangle's share in the recovered slope: its area times the slope of the linear field, and
/// what both change with its corners.
class Slope {
 public:
  Slope(const BoundaryMesh& mesh, int triangle, const Eigen::VectorXd& values)
      : area_(mesh.area(triangle)), normal_(mesh.normal(triangle)) {
    const auto& corners = mesh.triangles[triangle];
    for (int k = 0; k < 3; ++k) {
      opposite_[k] = mesh.nodes[corners[(k + 2) % 3]] - mesh.nodes[corners[(k + 1) % 3]];
      value_[k] = values[corners[k]];
      sum_ += value_[k] * opposite_[k];
    }
  }
  double area() const { return area_; }
  Vector3d timesArea() const { return 0.5 * normal_.cross(sum_); }
  Vector3d areaByCorner(int k) const { return 0.5 * normal_.cross(opposite_[k]); }
  /// Derivative of along · timesArea().
  Vector3d byCorner(int k, const Vector3d& along) const {
    const Vector3d ofNormal = 0.5 * sum_.cross(along);
    const Vector3d tangential = ofNormal - normal_ * normal_.dot(ofNormal);
    return tangential.cross(opposite_[k]) / (2 * area_) +
           0.5 * (value_[(k + 1) % 3] - value_[(k + 2) % 3]) * along.cross(normal_);
  }

 private:
  double area_;
  Vector3d normal_, sum_ = Vector3d::Zero();
  std::array<Vector3d, 3> opposite_;
  std::array<double, 3> value_{};
};

}  // namespace

Matrix3Xd bulgeDerivative(const BoundaryMesh& mesh, const TractionSlots& slots,
                          const DisplacementRecovery& recovery, const Eigen::VectorXd& values,
                          const BulgeWeights& weights) {
  const auto slopeAt = [&](int slot) {
    Vector3d sum = Vector3d::Zero();
    double area = 0;
    for (const int t : recovery.trianglesAround(slot)) {
      const Slope slope(mesh, t, values);
      sum += slope.timesArea();
      area += slope.area();
    }
    return std::pair<Vector3d, double>(sum / area, area);
  };
  Matrix3Xd result = Matrix3Xd::Zero(3, mesh.nodeCount());
  std::map<int, Vector3d> alongOf;  // Σ ±weight (x_b - x_a) / 2 of the edges that end at a slot
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int a = 0; a < 3; ++a) {
      const double half = weights[t][a] / 2;
      if (half == 0) continue;
      const int b = (a + 1) % 3, from = slots.ofCorner[t][a], to = slots.ofCorner[t][b];
      const auto& corners = mesh.triangles[t];
      const Vector3d edge = half * (mesh.nodes[corners[b]] - mesh.nodes[corners[a]]);
      alongOf.try_emplace(from, Vector3d::Zero()).first->second += edge;
      alongOf.try_emplace(to, Vector3d::Zero()).first->second -= edge;
      const Vector3d byEdge = half * (slopeAt(from).first - slopeAt(to).first);
      result.col(corners[b]) += byEdge;
      result.col(corners[a]) -= byEdge;
    }
  for (const auto& [slot, along] : alongOf) {
    const auto [slope, area] = slopeAt(slot);
    for (const int t : recovery.trianglesAround(slot)) {
      const Slope own(mesh, t, values);
      for (int k = 0; k < 3; ++k)
        result.col(mesh.triangles[t][k]) +=
            (own.byCorner(k, along) - slope.dot(along) * own.areaByCorner(k)) / area;
    }
  }
  return result;
}

}  // namespace palpa::bem

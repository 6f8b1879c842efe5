#include "bem/gradient/recovery_derivative.h"

#include <gtest/gtest.h>

#include <random>

#include "app/verification/exact/simple_meshes.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Random weights of the bulges of a mesh and random nodal values.
class RandomBulges {
 public:
  explicit RandomBulges(BoundaryMesh mesh) : mesh_(std::move(mesh)), slots_(mesh_) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    values_.resize(mesh_.nodeCount());
    for (double& value : values_) value = number(random);
    weights_.resize(static_cast<std::size_t>(mesh_.triangleCount()));
    for (auto& each : weights_)
      for (double& weight : each) weight = number(random);
  }

  /// Σ weight · b with a node moved by `motion`. Slots belong to the mesh at rest.
  double sum(int node, const Vector3d& motion) const {
    BoundaryMesh moved = mesh_;
    moved.nodes[node] += motion;
    const DisplacementRecovery recovery(moved, slots_);
    double sum = 0;
    for (int t = 0; t < moved.triangleCount(); ++t)
      for (int k = 0; k < 3; ++k)
        for (const auto& [at, weight] : recovery.bulge(t, k))
          sum += weights_[t][k] * weight * values_[at];
    return sum;
  }

  /// Largest difference from central differences over the largest derivative, at every fifth node.
  double error() const {
    const DisplacementRecovery recovery(mesh_, slots_);
    const Eigen::Matrix3Xd known = bulgeDerivative(mesh_, slots_, recovery, values_, weights_);
    const double step = 1e-5 * mesh_.meanEdgeLength();
    double error = 0;
    for (int node = 0; node < mesh_.nodeCount(); node += 5)
      for (int c = 0; c < 3; ++c) {
        const Vector3d motion = step * Vector3d::Unit(c);
        const double slope = (sum(node, motion) - sum(node, -motion)) / (2 * step);
        error = std::max(error, std::abs(slope - known(c, node)));
      }
    return error / known.cwiseAbs().maxCoeff();
  }

 private:
  BoundaryMesh mesh_;
  TractionSlots slots_;
  Eigen::VectorXd values_;
  BulgeWeights weights_;
};

TEST(RecoveryDerivative, FollowsCentralDifferences) {
  EXPECT_LT(RandomBulges(verification::sphereMesh(10, 3)).error(), 1e-7);
  // With edges: the slots on them have one-sided slopes.
  EXPECT_LT(RandomBulges(verification::boxMesh({0, 0, 0}, {4, 3, 2}, 4, 3, 2)).error(), 1e-7);
}

}  // namespace
}  // namespace palpa::bem

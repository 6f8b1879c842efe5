#include "bem/contact/stiffness_map.h"

#include <algorithm>
#include <limits>

#include "base/parallel.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Nodes per task: some milliseconds, enough to justify a workspace per task.
constexpr std::ptrdiff_t kPerTask = 32;

/// Compliance Ψ^T Xi Φ of one mask with all columns available.
Matrix3d complianceOf(const ContactMask& mask, const GreensColumns& columns,
                      const DegreesOfFreedom& dofs) {
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t m = 0; m < mask.measureNodes.size(); ++m) {
    const int measured = mask.measureNodes[m];
    Matrix3d moved = Matrix3d::Zero();  // displacement of the node in its frame per unit force
    for (std::size_t k = 0; k < mask.nodes.size(); ++k)
      for (int axis = 0; axis < 3; ++axis)
        moved.col(axis) += mask.traction[k] * Eigen::Map<const Eigen::Vector3f>(
                                                  columns.column(mask.nodes[k], axis) +
                                                  3 * static_cast<std::ptrdiff_t>(measured))
                                                  .cast<double>();
    if (!dofs.isFree(measured)) {
      // In the fixed directions the unknowns are tractions and the displacements zero.
      moved.topRows(dofs.constrained(measured)).setZero();
      moved = (dofs.frame(measured) * moved).eval();
    }
    sum += mask.measure[m] * moved;
  }
  return sum / dofs.tractionScale();
}

}  // namespace

StiffnessMap::StiffnessMap(const ContactSurface& surface, double radius)
    : surface_(surface),
      radius_(radius),
      compliances_(static_cast<std::size_t>(surface.meshSlots().count()), 0.0) {
  const BoundaryMesh& mesh = surface.mesh();
  std::vector<bool> isListed(mesh.nodes.size(), false);
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int node = mesh.triangles[t][corner];
      const int coefficient = surface.coefficientAt(node);
      if (isListed[node] || coefficient < 0) continue;
      isListed[node] = true;
      nodes_.push_back({surface.at(t, Vector3d::Unit(corner)), node, coefficient});
      for (int slot = surface.meshSlots().firstOfNode[node];
           slot < surface.meshSlots().firstOfNode[node + 1]; ++slot)
        compliances_[slot] = std::numeric_limits<double>::quiet_NaN();
    }
  isReady_.assign(nodes_.size(), 0);
}

int StiffnessMap::update(const GreensColumns& columns, const Job& job) {
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (isReady_[k] == 0 && columns.has(nodes_[k].coefficient)) wanted.push_back(k);
  // Works on copies, so that a cancelled call changes nothing.
  std::vector<double> compliances = compliances_;
  std::vector<char> isReady = isReady_;
  const auto count = static_cast<std::ptrdiff_t>(wanted.size());
  parallelFor((count + kPerTask - 1) / kPerTask, job, Phase::kStiffness, [&](std::ptrdiff_t task) {
    const auto workspace = surface_.makeWorkspace();
    ContactMask mask;
    for (std::ptrdiff_t i = task * kPerTask; i < std::min(count, (task + 1) * kPerTask); ++i) {
      job.throwIfCancelled();
      const std::size_t k = wanted[static_cast<std::size_t>(i)];
      const bool isPlaced = surface_.makeMask(nodes_[k].point, radius_, *workspace, mask);
      if (isPlaced && !columns.hasAll(mask.nodes)) continue;
      const Matrix3d compliance =
          isPlaced ? complianceOf(mask, columns, surface_.dofs()) : Matrix3d(Matrix3d::Zero());
      const int node = nodes_[k].node;
      for (int slot = surface_.meshSlots().firstOfNode[node];
           slot < surface_.meshSlots().firstOfNode[node + 1]; ++slot) {
        const Vector3d& normal = surface_.meshSlots().slots[slot].normal;
        // Positive for the exact problem; a coarse mesh may give negative values beside a
        // support.
        compliances[slot] = std::max(0.0, normal.dot(compliance * normal));
      }
      isReady[k] = 1;
    }
  });
  compliances_ = std::move(compliances);
  isReady_ = std::move(isReady);
  const int before = readyCount_;
  readyCount_ = static_cast<int>(std::count(isReady_.begin(), isReady_.end(), 1));
  return readyCount_ - before;
}

}  // namespace palpa::bem

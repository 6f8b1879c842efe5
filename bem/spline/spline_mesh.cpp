#include "bem/spline/spline_mesh.h"

#include <algorithm>
#include <utility>

#include "bem/spline/spline_state.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;
using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Applies `weights` to each component of vectors stored one after another.
void apply(const Weights& weights, const Eigen::MatrixXd& from, Eigen::MatrixXd& to) {
  to.resize(3 * weights.rows(), from.cols());
  for (Eigen::Index column = 0; column < from.cols(); ++column) {
    const Eigen::Map<const Eigen::Matrix3Xd> values(from.col(column).data(), 3, weights.cols());
    Eigen::Map<Eigen::Matrix3Xd> results(to.col(column).data(), 3, weights.rows());
    for (Eigen::Index row = 0; row < weights.rows(); ++row) {
      Vector3d sum = Vector3d::Zero();
      for (Weights::InnerIterator it(weights, row); it; ++it)
        sum += it.value() * values.col(it.col());
      results.col(row) = sum;
    }
  }
}

}  // namespace

SplineMesh::SplineMesh(const SplineSurface& surface, const SplineTractions& tractions,
                       const BoundaryMesh& mesh, const TractionSlots& meshSlots,
                       std::vector<Triangle> triangles)
    : surface_(surface),
      tractions_(tractions),
      mesh_(mesh),
      meshSlots_(meshSlots),
      triangles_(std::move(triangles)) {
  std::vector<Eigen::Triplet<double>> ofNodes, ofSlots;
  std::vector<bool> hasNode(mesh.nodes.size(), false), hasSlot(meshSlots.slots.size(), false);
  std::vector<double> basis, ofTractions;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int node = mesh.triangles[t][corner], slot = meshSlots.ofCorner[t][corner];
      if (hasNode[node] && hasSlot[slot]) continue;
      const Point point = at(t, Vector3d::Unit(corner));
      surface.evaluateBasis(point.element, point.parameters, basis);
      surface.evaluateTractionBasis(point.element, point.parameters, kMinWeight, ofTractions);
      for (std::size_t f = 0; f < basis.size(); ++f) {
        if (!hasNode[node] && basis[f] != 0)
          ofNodes.emplace_back(node, surface.functions(point.element)[f], basis[f]);
        if (!hasSlot[slot] && ofTractions[f] != 0)
          ofSlots.emplace_back(slot, tractions.ofFunction[point.element][f], ofTractions[f]);
      }
      hasNode[node] = hasSlot[slot] = true;
    }
  nodeWeights_.resize(mesh.nodeCount(), surface.coefficientCount());
  nodeWeights_.setFromTriplets(ofNodes.begin(), ofNodes.end());
  slotWeights_.resize(meshSlots.count(), tractions.slots.count());
  slotWeights_.setFromTriplets(ofSlots.begin(), ofSlots.end());
}

SplineMesh::Point SplineMesh::at(int triangle, const Vector3d& weights) const {
  const Triangle& in = triangles_[triangle];
  Eigen::Vector2d parameters = Eigen::Vector2d::Zero(), middle = Eigen::Vector2d::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    parameters += weights[corner] * in.corners[corner];
    middle += in.corners[corner] / 3;
  }
  const auto& patch = surface_.patches()[in.patch];
  // Of the elements that meet at a corner, choose the one that contains the triangle.
  std::array<int, 2> span{};
  for (int d = 0; d < 2; ++d) {
    const auto& knots = patch.basis[d].knots();
    parameters[d] = std::clamp(parameters[d], knots.front(), knots.back());
    const double size = knots.back() - knots.front();
    const double inside =
        parameters[d] + std::clamp(middle[d] - parameters[d], -1e-9 * size, 1e-9 * size);
    const auto& spans = patch.basis[d].spans();
    const auto next = std::partition_point(spans.begin(), spans.end(),
                                           [&](const auto& each) { return each.upper <= inside; });
    span[d] = static_cast<int>(std::min<std::ptrdiff_t>(
        next - spans.begin(), static_cast<std::ptrdiff_t>(spans.size()) - 1));
  }
  const std::vector<int>& elements = surface_.elementsAt(in.patch, span[0], span[1]);
  int best = elements.front();
  bool isInside = false;
  for (const int element : elements) {
    if (surface_.elements()[element].tag != mesh_.tags[triangle]) continue;
    if (surface_.elements()[best].tag != mesh_.tags[triangle]) best = element;
    if (isInside) break;
    if (surface_.placeIn(element, parameters[0], parameters[1])) {
      best = element;
      isInside = true;
    }
  }
  return {best, parameters};
}

void SplineMesh::displacements(const Eigen::MatrixXd& coefficients,
                               Eigen::MatrixXd& ofNodes) const {
  apply(nodeWeights_, coefficients, ofNodes);
}

void SplineMesh::tractions(const Eigen::MatrixXd& coefficients, Eigen::MatrixXd& ofSlots) const {
  apply(slotWeights_, coefficients, ofSlots);
}

}  // namespace palpa::bem

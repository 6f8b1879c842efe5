#include "modeling/solid/edge_band.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modeling/solid/solid_check.h"

namespace palpa::modeling {
namespace {

/// Row of control points adjacent to a side, in growing parameter.
std::vector<int> nextRow(const Patch& patch, Side side) {
  const auto& net = patch.net;
  if (side == Side::kUMin) return net[1];
  if (side == Side::kUMax) return net[net.size() - 2];
  std::vector<int> indices;
  for (const auto& row : net) indices.push_back(side == Side::kVMin ? row[1] : row[row.size() - 2]);
  return indices;
}

}  // namespace

EdgeBand bandOf(const Solid& solid, int edge) {
  const SolidEdge& from = solid.edges()[edge];
  const auto [first, second] = from.uses;
  const Patch& patch = solid.patches()[first.patch];
  const int direction = directionOf(first.side);
  EdgeBand band{edge,
                patch.degree[direction],
                patch.knots[direction],
                {sideIndices(patch, first.side), nextRow(patch, first.side),
                 nextRow(solid.patches()[second.patch], second.side)}};
  if (from.reversed)
    std::reverse(band.rows[EdgeBand::inSecond].begin(), band.rows[EdgeBand::inSecond].end());
  return band;
}

std::vector<BasisFunctions> bandSamples(const EdgeBand& band, int perSpan) {
  std::vector<BasisFunctions> samples{basisAt(band.knots, band.degree, band.knots.front())};
  for (std::size_t i = 1; i < band.knots.size(); ++i) {
    const double low = band.knots[i - 1];
    const double high = band.knots[i];
    if (high == low) continue;
    for (int k = 1; k <= perSpan; ++k)
      samples.push_back(
          basisAt(band.knots, band.degree, k == perSpan ? high : low + (high - low) * k / perSpan));
  }
  return samples;
}

std::optional<TangentRelation> tangentRelation(const EdgeBand& band, const BasisFunctions& at,
                                               const std::vector<Eigen::Vector3d>& points) {
  constexpr double kParallel = 1e-3;  // sine below which two derivatives do not span a plane
  TangentRelation relation;
  for (int k = 0; k <= band.degree; ++k) {
    const int i = at.first + k;
    const Eigen::Vector3d& onEdge = points[band.rows[EdgeBand::onEdge][i]];
    relation.a += at.value[k] * (points[band.rows[EdgeBand::inFirst][i]] - onEdge);
    relation.b += at.value[k] * (points[band.rows[EdgeBand::inSecond][i]] - onEdge);
    relation.e += at.derivative[k] * onEdge;
  }
  const auto& [a, b, e, normal, angle, factor] = relation;
  // Both point to the same side of the surface, because a and b lie on different sides of the edge.
  const Eigen::Vector3d first = e.cross(a);
  const Eigen::Vector3d second = b.cross(e);
  const double firstLength = first.norm();
  const double secondLength = second.norm();
  if (!(firstLength > kParallel * a.norm() * e.norm()) ||
      !(secondLength > kParallel * b.norm() * e.norm()))
    return std::nullopt;
  const Eigen::Vector3d n1 = first / firstLength;
  const Eigen::Vector3d n2 = second / secondLength;
  relation.angle = std::atan2(n1.cross(n2).norm(), n1.dot(n2));
  const Eigen::Vector3d sum = n1 + n2;
  if (sum.norm() < kParallel) return relation;
  relation.normal = sum.normalized();
  // det(a, b, e) = n · (kappa a + lambda b + mu e) for the three plane determinants; the sine of
  // the angle is |e| det(a, b, e) / (|e × a| |b × e|).
  const double scale = e.norm() / (firstLength * secondLength);
  relation.factor = {scale * normal.dot(second), scale * normal.dot(first),
                     scale * normal.dot(a.cross(b))};
  return relation;
}

}  // namespace palpa::modeling

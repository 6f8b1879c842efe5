#include "modeling/measure/patch_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Edges continue without a corner below this angle, rad.
constexpr double kSmoothTurn = 0.02;

/// Nodes (in 0 … 1) and weights of Gauss' rule with 5 points, exact for polynomials of degree 9
/// (Abramowitz & Stegun, table 25.4).
constexpr std::array<std::array<double, 2>, 5> kGauss{{{0.046910077030668, 0.118463442528095},
                                                       {0.230765344947158, 0.239314335249683},
                                                       {0.5, 0.284444444444444},
                                                       {0.769234655052842, 0.239314335249683},
                                                       {0.953089922969332, 0.118463442528095}}};

}  // namespace

Vector2d PatchEdges::uvOf(const PatchEdge& edge, double t) const {
  const auto across = search_.range(edge.patch, 1 - directionOf(edge.side));
  const bool atEnd = edge.side == Side::kUMax || edge.side == Side::kVMax;
  const double fixed = atEnd ? across[1] : across[0];
  return directionOf(edge.side) == 0 ? Vector2d(t, fixed) : Vector2d(fixed, t);
}

EdgePoint PatchEdges::pointAt(const PatchEdge& edge, double t) const {
  const PatchJet s = search_.jet(edge.patch, uvOf(edge, t));
  const Vector3d& first = directionOf(edge.side) == 0 ? s.u : s.v;
  const Vector3d& second = directionOf(edge.side) == 0 ? s.uu : s.vv;
  EdgePoint point{s.position, first.normalized()};
  const Vector3d across = second - second.dot(point.tangent) * point.tangent;
  point.curvature = across / first.squaredNorm();
  const double flat = curvatureError();
  if (!(point.curvature.norm() >= flat))
    point.curvature.setZero();
  else
    point.accuracy = flat / point.curvature.squaredNorm();
  return point;
}

PatchPoint PatchEdges::nearest(const PatchEdge& edge, const Vector3d& x) const {
  const auto& spans = search_.spans(edge.patch, directionOf(edge.side));
  PatchPoint best{edge.patch};
  double least = std::numeric_limits<double>::infinity();
  constexpr int kStarts = 4;
  for (std::size_t i = 1; i < spans.size(); ++i)
    for (int k = 0; k < kStarts; ++k) {
      double t = spans[i - 1] + (spans[i] - spans[i - 1]) * (k + 0.5) / kStarts;
      for (int step = 0; step < 40; ++step) {
        const PatchJet s = search_.jet(edge.patch, uvOf(edge, t));
        const Vector3d& first = directionOf(edge.side) == 0 ? s.u : s.v;
        const Vector3d& second = directionOf(edge.side) == 0 ? s.uu : s.vv;
        const Vector3d r = s.position - x;
        const double gauss = first.squaredNorm();
        const double newton = gauss + r.dot(second);
        const double way = -r.dot(first) / (newton > 1e-3 * gauss ? newton : gauss);
        const double next = std::clamp(t + way, spans.front(), spans.back());
        const double moved = std::abs(next - t) * std::sqrt(gauss);
        t = next;
        if (moved <= 1e-15 * search_.size()) break;
      }
      const Vector2d uv = uvOf(edge, t);
      const Vector3d position = search_.position(edge.patch, uv);
      const double distance = (position - x).norm();
      if (distance >= least) continue;
      least = distance;
      best = {edge.patch, uv, position};
    }
  return best;
}

std::vector<Vector3d> PatchEdges::line(const PatchEdge& edge, int pieces) const {
  std::vector<Vector3d> points;
  const auto& spans = search_.spans(edge.patch, directionOf(edge.side));
  for (std::size_t i = 1; i < spans.size(); ++i)
    for (int k = i == 1 ? 0 : 1; k <= pieces; ++k)
      points.push_back(search_.position(
          edge.patch, uvOf(edge, spans[i - 1] + (spans[i] - spans[i - 1]) * k / pieces)));
  return points;
}

PatchEdges::Length PatchEdges::lengthOf(const PatchEdge& edge) const {
  const auto& spans = search_.spans(edge.patch, directionOf(edge.side));
  const auto sum = [&](int parts) {
    double length = 0;
    for (std::size_t i = 1; i < spans.size(); ++i)
      for (int k = 0; k < parts; ++k) {
        const double step = (spans[i] - spans[i - 1]) / parts;
        for (const auto& [node, weight] : kGauss) {
          const PatchJet s = search_.jet(edge.patch, uvOf(edge, spans[i - 1] + (k + node) * step));
          length += weight * step * (directionOf(edge.side) == 0 ? s.u : s.v).norm();
        }
      }
    return length;
  };
  const double fine = sum(4);
  return {fine, std::abs(fine - sum(2)) + kMeasuredRounding * fine};
}

double PatchEdges::chainLength(int first) const {
  std::set<int> chain{first};
  for (const int end : {0, 1}) {
    int edge = first;
    int vertex = solid_.edges()[edge].vertices[end];
    for (std::optional<int> next; (next = continuation(edge, vertex));) {
      if (!chain.insert(*next).second) break;
      edge = *next;
      const auto& ends = solid_.edges()[edge].vertices;
      vertex = ends[0] == vertex ? ends[1] : ends[0];
    }
  }
  double length = 0;
  for (const int edge : chain) length += lengthOf(solid_.edges()[edge].uses[0]).value;
  return length;
}

Vector3d PatchEdges::away(int index, int vertex) const {
  const SolidEdge& edge = solid_.edges()[index];
  const PatchEdge& use = edge.uses[0];
  const auto [low, high] = search_.range(use.patch, directionOf(use.side));
  return edge.vertices[0] == vertex ? pointAt(use, low).tangent
                                    : Vector3d(-pointAt(use, high).tangent);
}

std::optional<int> PatchEdges::continuation(int edge, int vertex) const {
  const auto& edges = solid_.edges();
  const Vector3d ahead = -away(edge, vertex);
  std::optional<int> best;
  double least = kSmoothTurn;
  for (int other = 0; other < static_cast<int>(edges.size()); ++other) {
    if (other == edge || edges[other].smooth != edges[edge].smooth) continue;
    if (edges[other].vertices[0] != vertex && edges[other].vertices[1] != vertex) continue;
    const Vector3d direction = away(other, vertex);
    const double turn = std::atan2(ahead.cross(direction).norm(), ahead.dot(direction));
    if (turn >= least) continue;
    least = turn;
    best = other;
  }
  return best;
}

}  // namespace palpa::modeling

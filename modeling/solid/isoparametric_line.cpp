#include "modeling/solid/isoparametric_line.h"

#include <algorithm>

#include "modeling/solid/basis.h"

namespace palpa::modeling {
namespace {

/// Parameters of the samples along a line.
std::vector<double> samples(const std::vector<double>& knots, int piecesPerSpan) {
  std::vector<double> result{knots.front()};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    if (knots[i] == knots[i - 1]) continue;
    for (int k = 1; k <= piecesPerSpan; ++k)
      result.push_back(knots[i - 1] + (knots[i] - knots[i - 1]) * k / piecesPerSpan);
  }
  return result;
}

}  // namespace

Eigen::Vector3d surfacePoint(const Solid& solid, int patch, double u, double v) {
  const Patch& at = solid.patches()[patch];
  const auto basis = [&](int direction, double parameter) {
    const auto [low, high] = at.range(direction);
    return basisAt(at.knots[direction], at.degree[direction], std::clamp(parameter, low, high));
  };
  const BasisFunctions a = basis(0, u);
  const BasisFunctions b = basis(1, v);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int i = 0; i <= at.degree[0]; ++i)
    for (int j = 0; j <= at.degree[1]; ++j)
      point += a.value[i] * b.value[j] * solid.controlPoints()[at.net[a.first + i][b.first + j]];
  return point;
}

std::vector<Eigen::Vector3d> isoparametricLine(const Solid& solid, PatchDirection at,
                                               double parameter, int piecesPerSpan) {
  std::vector<Eigen::Vector3d> line;
  const int other = 1 - at.direction;
  for (double t : samples(solid.patches()[at.patch].knots[other], piecesPerSpan))
    line.push_back(at.direction == 0 ? surfacePoint(solid, at.patch, parameter, t)
                                     : surfacePoint(solid, at.patch, t, parameter));
  return line;
}

std::vector<std::vector<Eigen::Vector3d>> knotLinesOf(const Solid& solid, PatchDirection at,
                                                      double parameter) {
  const auto [low, high] = solid.patches()[at.patch].range(at.direction);
  const double fraction = (parameter - low) / (high - low);
  std::vector<std::vector<Eigen::Vector3d>> lines;
  for (const ChainLink& link : chainOf(solid, at)) {
    const auto [from, to] = solid.patches()[link.at.patch].range(link.at.direction);
    const double there = link.reversed ? 1.0 - fraction : fraction;
    lines.push_back(isoparametricLine(solid, link.at, from + there * (to - from)));
  }
  return lines;
}

std::vector<double> innerKnots(const Solid& solid, PatchDirection at) {
  const Patch& patch = solid.patches()[at.patch];
  const auto [low, high] = patch.range(at.direction);
  std::vector<double> result;
  for (double knot : patch.knots[at.direction])
    if (knot > low && knot < high && (result.empty() || knot != result.back()))
      result.push_back(knot);
  return result;
}

}  // namespace palpa::modeling

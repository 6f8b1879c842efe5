#include "modeling/solid/weld.h"

#include <map>
#include <utility>

#include "modeling/solid/solid_check.h"

namespace palpa::modeling {
namespace {

/// Row and column of point k of a side (in growing parameter) in the net.
std::pair<int, int> netPosition(Side side, int k, int rows, int columns) {
  switch (side) {
    case Side::kVMin:
      return {k, 0};
    case Side::kUMax:
      return {rows - 1, k};
    case Side::kVMax:
      return {k, columns - 1};
    default:
      return {0, k};
  }
}

}  // namespace

PatchNet netOf(const Solid& solid, int patch) {
  const Patch& from = solid.patches()[patch];
  PatchNet result{from.degree, from.knots, {}, {}};
  for (const auto& row : from.net) {
    result.points.emplace_back();
    for (int index : row) result.points.back().push_back(solid.controlPoints()[index]);
  }
  return result;
}

Solid weld(const Solid& before, const std::vector<PatchNet>& nets) {
  std::vector<Patch> patches;
  for (std::size_t p = 0; p < nets.size(); ++p)
    patches.push_back(
        {before.patches()[p].name, nets[p].degree, nets[p].knots,
         std::vector<std::vector<int>>(nets[p].points.size(),
                                       std::vector<int>(nets[p].points.front().size(), -1))});

  // Every position in every net gets a point; glued positions get the same point.
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](const Eigen::Vector3d& position) {
    points.push_back(position);
    return static_cast<int>(points.size()) - 1;
  };
  const auto place = [&](PatchEdge edge, int k) -> int& {
    auto& net = patches[edge.patch].net;
    const auto [i, j] = netPosition(edge.side, k, static_cast<int>(net.size()),
                                    static_cast<int>(net.front().size()));
    return net[i][j];
  };
  std::map<int, int> pointOfVertex;
  const auto vertex = [&](int old) {
    const auto [found, added] = pointOfVertex.emplace(old, 0);
    if (added) found->second = add(before.controlPoints()[old]);
    return found->second;
  };
  std::vector<PatchEdge> smooth;
  for (const SolidEdge& edge : before.edges()) {
    const auto [first, second] = edge.uses;
    if (edge.smooth) smooth.push_back(first);
    const PatchNet& net = nets[first.patch];
    const int rows = static_cast<int>(net.points.size());
    const int columns = static_cast<int>(net.points.front().size());
    const int count = directionOf(first.side) == 0 ? rows : columns;
    const bool changed = net.changed[directionOf(first.side)];
    const std::vector<int> old = sideIndices(before.patches()[first.patch], first.side);
    for (int k = 0; k < count; ++k) {
      int index = -1;
      if (k == 0 || k == count - 1) {
        index = vertex(k == 0 ? old.front() : old.back());
      } else if (changed) {
        const auto [i, j] = netPosition(first.side, k, rows, columns);
        index = add(net.points[i][j]);
      } else {
        index = add(before.controlPoints()[old[k]]);
      }
      place(first, k) = index;
      place(second, edge.reversed ? count - 1 - k : k) = index;
    }
  }

  // Numbered in the order of use, so that the numbers follow the patches.
  std::vector<int> numberOf;
  std::vector<Eigen::Vector3d> ordered;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t i = 0; i < patches[p].net.size(); ++i)
      for (std::size_t j = 0; j < patches[p].net[i].size(); ++j) {
        int& index = patches[p].net[i][j];
        if (index < 0) index = add(nets[p].points[i][j]);
        numberOf.resize(points.size(), -1);
        if (numberOf[index] < 0) {
          numberOf[index] = static_cast<int>(ordered.size());
          ordered.push_back(points[index]);
        }
        index = numberOf[index];
      }
  return Solid(std::move(ordered), std::move(patches), smooth);
}

}  // namespace palpa::modeling

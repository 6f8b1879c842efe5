#include "modeling/solid/solid.h"

#include <stdexcept>
#include <utility>

#include "modeling/solid/solid_check.h"

namespace palpa::modeling {

std::string_view sideName(Side side) {
  constexpr std::array<std::string_view, 4> kNames{"v-min", "u-max", "v-max", "u-min"};
  return kNames[static_cast<int>(side)];
}

Solid::Solid() {
  static const auto empty = std::make_shared<const Topology>();
  topology_ = empty;
}

Solid::Solid(std::vector<Eigen::Vector3d> controlPoints, std::vector<Patch> patches,
             const std::vector<PatchEdge>& smoothEdges)
    : controlPoints_(std::move(controlPoints)) {
  checkPatches(controlPoints_, patches);
  auto topology = std::make_shared<Topology>();
  topology->edges = glueSides(patches);
  checkVertexFans(patches, topology->edges);
  checkOutward(controlPoints_, patches);
  topology->edgeOfSide.assign(patches.size(), {-1, -1, -1, -1});
  for (std::size_t edge = 0; edge < topology->edges.size(); ++edge)
    for (const PatchEdge& use : topology->edges[edge].uses)
      topology->edgeOfSide[use.patch][static_cast<int>(use.side)] = static_cast<int>(edge);
  topology->patches = std::move(patches);
  for (const PatchEdge& edge : smoothEdges)
    topology->edges[topology->edgeOfSide[edge.patch][static_cast<int>(edge.side)]].smooth = true;
  topology_ = std::move(topology);
}

Solid Solid::withControlPoints(std::vector<Eigen::Vector3d> controlPoints) const {
  if (controlPoints.size() != controlPoints_.size())
    throw std::invalid_argument("Solid::withControlPoints: the number of points differs");
  checkPoints(controlPoints);
  checkOutward(controlPoints, patches());
  Solid result = *this;
  result.controlPoints_ = std::move(controlPoints);
  return result;
}

Solid Solid::withSmoothEdges(const std::vector<int>& edges, bool smooth) const {
  auto topology = std::make_shared<Topology>(*topology_);
  for (int edge : edges) topology->edges.at(edge).smooth = smooth;
  Solid result = *this;
  result.topology_ = std::move(topology);
  return result;
}

std::array<int, 2> Solid::verticesOf(int patch, Side side) const {
  const auto& net = topology_->patches[patch].net;
  const auto& first = net.front();
  const auto& last = net.back();
  switch (side) {
    case Side::kVMin:
      return {first.front(), last.front()};
    case Side::kUMax:
      return {last.front(), last.back()};
    case Side::kVMax:
      return {first.back(), last.back()};
    default:
      return {first.front(), first.back()};
  }
}

std::optional<int> Solid::findPatch(std::string_view name) const {
  for (std::size_t i = 0; i < topology_->patches.size(); ++i)
    if (topology_->patches[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

}  // namespace palpa::modeling

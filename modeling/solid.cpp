#include "modeling/solid.h"

#include <utility>

#include "modeling/solid_check.h"

namespace palpa::modeling {

std::string_view sideName(Side side) {
  constexpr std::array<std::string_view, 4> kNames{"v-min", "u-max", "v-max", "u-min"};
  return kNames[static_cast<int>(side)];
}

Solid::Solid(std::vector<Eigen::Vector3d> controlPoints, std::vector<Patch> patches)
    : controlPoints_(std::move(controlPoints)), patches_(std::move(patches)) {
  checkPatches(controlPoints_, patches_);
  edges_ = glueSides(patches_);
  checkVertexFans(patches_, edges_);
  checkOutward(controlPoints_, patches_);

  edgeOfSide_.assign(patches_.size(), {-1, -1, -1, -1});
  for (std::size_t edge = 0; edge < edges_.size(); ++edge)
    for (const PatchEdge& use : edges_[edge].uses)
      edgeOfSide_[use.patch][static_cast<int>(use.side)] = static_cast<int>(edge);
}

std::array<int, 2> Solid::verticesOf(int patch, Side side) const {
  const auto& net = patches_[patch].net;
  const auto& first = net.front();
  const auto& last = net.back();
  switch (side) {
    case Side::vMin:
      return {first.front(), last.front()};
    case Side::uMax:
      return {last.front(), last.back()};
    case Side::vMax:
      return {first.back(), last.back()};
    default:
      return {first.front(), first.back()};
  }
}

std::optional<int> Solid::findPatch(std::string_view name) const {
  for (std::size_t i = 0; i < patches_.size(); ++i)
    if (patches_[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

std::string Solid::patchNames() const {
  std::string text;
  for (const Patch& patch : patches_) text += (text.empty() ? "\"" : ", \"") + patch.name + "\"";
  return text;
}

}  // namespace palpa::modeling

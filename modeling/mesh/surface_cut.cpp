#include "modeling/mesh/surface_cut.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {
namespace {

constexpr double kRounding = 1e-9;  // of the longest extent; nearer vertices lie on the border
constexpr double kAlong = 0.1;      // largest slope against the border of an edge that snaps to it

/// Signed distances of all vertices from the border in mm, exactly 0 for those that lie on it.
struct Distances {
  std::vector<double> exact;
  std::vector<double> snapped;  ///< with the features that run along the border put onto it
};

Distances distances(const TaggedSurface& surface, const HalfSpace& half, double snap) {
  Eigen::Vector3d low = surface.positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : surface.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double tolerance = kRounding * (high - low).norm();
  std::vector<double> exact;
  for (const Eigen::Vector3d& p : surface.positions) {
    const double d = half.value(p) / half.normal.norm();
    exact.push_back(std::abs(d) <= tolerance ? 0.0 : d);
  }
  std::vector<double> snapped = exact;
  const auto neighbours = triangleNeighbours(surface.triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (surface.tags[t] == surface.tags[neighbours[t][k]]) continue;
      const int a = surface.triangles[t][k];
      const int b = surface.triangles[t][(k + 1) % 3];
      const double length = (surface.positions[a] - surface.positions[b]).norm();
      if (std::abs(exact[a]) <= snap && std::abs(exact[b]) <= snap &&
          std::abs(exact[a] - exact[b]) <= kAlong * length)
        snapped[a] = snapped[b] = 0.0;
    }
  return {std::move(exact), std::move(snapped)};
}

class Cutter {
 public:
  Cutter(TaggedSurface& surface, Distances distances)
      : surface_(surface),
        exact_(std::move(distances.exact)),
        distance_(std::move(distances.snapped)) {}

  void cut() {
    const std::size_t before = surface_.triangles.size();
    for (std::size_t t = 0; t < before; ++t) cutTriangle(t);
  }

  bool isInside(const std::array<int, 3>& n) const {
    const double sum = distance_[n[0]] + distance_[n[1]] + distance_[n[2]];
    // A triangle in the border, or put onto it, lies where it was before.
    return (sum != 0.0 ? sum : exact_[n[0]] + exact_[n[1]] + exact_[n[2]]) < 0.0;
  }

 private:
  bool isCrossed(int a, int b) const { return distance_[a] * distance_[b] < 0.0; }

  int crossing(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [place, isNew] =
        onEdge_.try_emplace({low, high}, static_cast<int>(surface_.positions.size()));
    if (isNew) {
      const double s = distance_[low] / (distance_[low] - distance_[high]);
      surface_.positions.push_back((1.0 - s) * surface_.positions[low] +
                                   s * surface_.positions[high]);
      distance_.push_back(0.0);
      exact_.push_back(0.0);
    }
    return place->second;
  }

  void add(const std::array<int, 3>& nodes, const SurfaceTag& tag) {
    surface_.triangles.push_back(nodes);
    surface_.tags.push_back(tag);
  }

  void cutTriangle(std::size_t t) {
    std::array<int, 3> n = surface_.triangles[t];
    const SurfaceTag tag = surface_.tags[t];
    const auto crossed = [&](int k) { return isCrossed(n[k], n[(k + 1) % 3]); };
    const int count = crossed(0) + crossed(1) + crossed(2);
    if (count == 0) return;
    // One crossed edge: it becomes 0–1. Two: corner 0 is alone on its side.
    while (count == 1 ? !crossed(0) : crossed(1)) std::rotate(n.begin(), n.begin() + 1, n.end());
    if (count == 1) {
      const int m = crossing(n[0], n[1]);
      surface_.triangles[t] = {n[0], m, n[2]};
      add({m, n[1], n[2]}, tag);
      return;
    }
    const int m = crossing(n[0], n[1]);
    const int p = crossing(n[2], n[0]);
    surface_.triangles[t] = {n[0], m, p};
    const auto& at = surface_.positions;
    if ((at[m] - at[n[2]]).norm() < (at[n[1]] - at[p]).norm()) {
      add({m, n[1], n[2]}, tag);
      add({m, n[2], p}, tag);
    } else {
      add({m, n[1], p}, tag);
      add({n[1], n[2], p}, tag);
    }
  }

  TaggedSurface& surface_;
  std::vector<double> exact_;
  std::vector<double> distance_;
  std::map<std::pair<int, int>, int> onEdge_;
};

}  // namespace

void cutAtBorder(TaggedSurface& surface, const HalfSpace& half, int k, double snap) {
  Cutter cutter(surface, distances(surface, half, snap));
  cutter.cut();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (cutter.isInside(surface.triangles[t])) surface.tags[t].sides |= std::uint64_t{1} << k;
}

}  // namespace palpa::modeling

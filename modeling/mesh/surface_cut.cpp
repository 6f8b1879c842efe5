#include "modeling/mesh/surface_cut.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "modeling/body/smooth_regions.h"

namespace palpa::modeling {
namespace {

constexpr double kRounding = 1e-9;  // of the longest extent; nearer vertices lie on the border
constexpr double kAlong = 0.1;      // largest slope against the border of an edge that snaps to it

/// Signed distances of all vertices from the border in mm, exactly 0 on the border.
struct Distances {
  std::vector<double> exact;
  std::vector<double> snapped;  ///< also 0 on features that run along the border
};

Distances distances(const TaggedSurface& surface, const RegionBorder& border, double snap) {
  Eigen::Vector3d low = surface.positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : surface.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double tolerance = kRounding * (high - low).norm();
  std::vector<double> exact;
  for (const Eigen::Vector3d& p : surface.positions) {
    const double d = border.value(p) / border.slope();
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
  Cutter(TaggedSurface& surface, const RegionBorder& border, Distances distances)
      : surface_(surface),
        border_(border),
        exact_(std::move(distances.exact)),
        distance_(std::move(distances.snapped)) {}

  void cut() {
    const std::size_t before = surface_.triangles.size();
    for (std::size_t t = 0; t < before; ++t) cutTriangle(t);
  }

  bool isInside(const std::array<int, 3>& n) const {
    const double sum = distance_[n[0]] + distance_[n[1]] + distance_[n[2]];
    // For a triangle that was snapped onto the border the exact distances decide.
    return (sum != 0.0 ? sum : exact_[n[0]] + exact_[n[1]] + exact_[n[2]]) < 0.0;
  }

 private:
  bool isCrossed(int a, int b) const { return distance_[a] * distance_[b] < 0.0; }

  /// Fraction of the edge a–b at the crossing: linear for half spaces; for strokes by bisection
  /// with the exact distances.
  double crossingPart(int a, int b) const {
    if (!border_.isPainted() || exact_[a] * exact_[b] >= 0.0)
      return distance_[a] / (distance_[a] - distance_[b]);
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 50; ++i) {
      const double s = 0.5 * (low + high);
      const double value =
          border_.value((1.0 - s) * surface_.positions[a] + s * surface_.positions[b]);
      (value * exact_[a] > 0.0 ? low : high) = s;
    }
    return 0.5 * (low + high);
  }

  int crossing(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [place, isNew] =
        onEdge_.try_emplace({low, high}, static_cast<int>(surface_.positions.size()));
    if (isNew) {
      const double s = crossingPart(low, high);
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
    // Rotated so that one crossed edge is 0–1; with two, corner 0 is alone on its side.
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
  const RegionBorder& border_;
  std::vector<double> exact_;
  std::vector<double> distance_;
  std::map<std::pair<int, int>, int> onEdge_;
};

/// Divides triangles near the border of strokes at the middles of their long edges.
void divideNear(TaggedSurface& surface, const RegionBorder& border, double edgeLength) {
  constexpr double kOfStroke = 0.6;  // of the edges of the later mesh
  constexpr double kOfLength = 0.5;
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    std::map<std::pair<int, int>, int> middles;  // -1: the edge is not divided
    const auto middleOf = [&](int a, int b) {
      const auto [low, high] = std::minmax(a, b);
      const auto [place, isNew] = middles.try_emplace({low, high}, -1);
      if (!isNew) return place->second;
      const Eigen::Vector3d middle = 0.5 * (surface.positions[low] + surface.positions[high]);
      const double length = (surface.positions[low] - surface.positions[high]).norm();
      const double wanted =
          std::min(kOfStroke * border.edgeAt(middle, edgeLength), kOfLength * edgeLength);
      if (length > wanted && std::abs(border.value(middle)) <= length) {
        place->second = static_cast<int>(surface.positions.size());
        surface.positions.push_back(middle);
      }
      return place->second;
    };
    const std::size_t before = surface.triangles.size();
    bool changed = false;
    for (std::size_t t = 0; t < before; ++t) {
      std::array<int, 3> n = surface.triangles[t];
      std::array<int, 3> m{middleOf(n[0], n[1]), middleOf(n[1], n[2]), middleOf(n[2], n[0])};
      const auto count = std::count_if(m.begin(), m.end(), [](int node) { return node >= 0; });
      if (count == 0) continue;
      changed = true;
      const SurfaceTag tag = surface.tags[t];
      const auto add = [&](int a, int b, int c) {
        surface.triangles.push_back({a, b, c});
        surface.tags.push_back(tag);
      };
      const auto turn = [&] {
        std::rotate(n.begin(), n.begin() + 1, n.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      };
      if (count == 1) {  // edge 0–1
        while (m[0] < 0) turn();
        surface.triangles[t] = {n[0], m[0], n[2]};
        add(m[0], n[1], n[2]);
      } else if (count == 2) {  // edges 0–1 and 1–2
        while (m[2] >= 0) turn();
        surface.triangles[t] = {m[0], n[1], m[1]};
        add(n[0], m[0], n[2]);
        add(m[0], m[1], n[2]);
      } else {
        surface.triangles[t] = {m[0], m[1], m[2]};
        add(n[0], m[0], m[2]);
        add(m[0], n[1], m[1]);
        add(m[2], m[1], n[2]);
      }
    }
    if (!changed) return;
  }
}

}  // namespace

void cutAtBorder(TaggedSurface& surface, const RegionBorder& border, int k, double snap,
                 double edgeLength) {
  if (border.isPainted()) divideNear(surface, border, edgeLength);
  Cutter cutter(surface, border, distances(surface, border, snap));
  cutter.cut();
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (cutter.isInside(surface.triangles[t])) surface.tags[t].sides |= std::uint64_t{1} << k;
}

}  // namespace palpa::modeling

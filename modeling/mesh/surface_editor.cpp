#include "modeling/mesh/surface_editor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 0.77;     // cosine of 40°: a stronger turn of a feature is a corner
constexpr double kSameSide = 0.5;  // least cosine between a triangle's old and new normal
constexpr double kMaxCollapseSag = 0.14;  // of an edge; more would lose a curved surface
constexpr double kFlatStar = 0.98;        // cosine of 11°: edges over flatter stars sag less

}  // namespace

SurfaceEditor::SurfaceEditor(const TaggedSurface& surface, const OriginalSurface& original,
                             const SizeField& sizes)
    : original_(original),
      field_(sizes),
      positions_(surface.positions),
      triangles_(surface.triangles),
      tags_(surface.tags),
      sizes_(positions_.size()),
      corner_(positions_.size(), false),
      around_(positions_.size()) {
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int node : triangles_[t]) around_[node].push_back(static_cast<int>(t));
  updateSizes();
  for (int node = 0; node < nodeCount(); ++node) {
    const std::vector<int> rails = featureNeighbours(node);
    if (rails.empty()) continue;
    corner_[node] =
        rails.size() != 2 || cosineBetween(positions_[node] - positions_[rails[0]],
                                           positions_[rails[1]] - positions_[node]) < kTurn;
  }
}

TaggedSurface SurfaceEditor::result() const {
  TaggedSurface surface;
  std::vector<int> number(positions_.size(), -1);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    if (around_[i].empty()) continue;
    number[i] = static_cast<int>(surface.positions.size());
    surface.positions.push_back(positions_[i]);
  }
  for (int t = 0; t < triangleCount(); ++t) {
    if (!isAlive(t)) continue;
    const auto [a, b, c] = triangles_[t];
    surface.triangles.push_back({number[a], number[b], number[c]});
    surface.tags.push_back(tags_[t]);
  }
  return surface;
}

int SurfaceEditor::leftOf(int a, int b) const {
  for (int t : around_[a]) {
    const auto& n = triangles_[t];
    for (int k = 0; k < 3; ++k)
      if (n[k] == a && n[(k + 1) % 3] == b) return t;
  }
  return -1;
}

bool SurfaceEditor::isFeature(int a, int b) const {
  return tags_[leftOf(a, b)] != tags_[leftOf(b, a)];
}

double SurfaceEditor::relativeLength(int a, int b) const {
  return length(a, b) / (0.5 * (sizes_[a] + sizes_[b]));
}

double SurfaceEditor::smallestAngleCosine(int triangle) const {
  const auto [a, b, c] = triangles_[triangle];
  return std::max({cornerCosine(positions_[a], positions_[b], positions_[c]),
                   cornerCosine(positions_[b], positions_[c], positions_[a]),
                   cornerCosine(positions_[c], positions_[a], positions_[b])});
}

void SurfaceEditor::updateSizes() {
  for (std::size_t i = 0; i < positions_.size(); ++i) sizes_[i] = field_.at(positions_[i]);
}

std::vector<int> SurfaceEditor::neighbours(int node) const {
  std::vector<int> result;
  for (int t : around_[node])
    for (int k = 0; k < 3; ++k)
      if (triangles_[t][k] == node) result.push_back(triangles_[t][(k + 1) % 3]);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<int> SurfaceEditor::featureNeighbours(int node) const {
  const SurfaceTag& first = tags_[around_[node].front()];
  if (std::all_of(around_[node].begin(), around_[node].end(),
                  [&](int t) { return tags_[t] == first; }))
    return {};
  std::vector<int> result = neighbours(node);
  std::erase_if(result, [&](int other) { return !isFeature(node, other); });
  return result;
}

Vector3d SurfaceEditor::normal(const std::array<int, 3>& n) const {
  return (positions_[n[1]] - positions_[n[0]]).cross(positions_[n[2]] - positions_[n[0]]);
}

Vector3d SurfaceEditor::normalWith(const std::array<int, 3>& n, int node,
                                   const Vector3d& there) const {
  const auto at = [&](int k) { return n[k] == node ? there : positions_[n[k]]; };
  const Vector3d origin = at(0);
  return (at(1) - origin).cross(at(2) - origin);
}

/// Nearest point to `point` on the original of the edge a–b: its feature line, or the smooth region
/// it runs in.
Vector3d SurfaceEditor::onOriginal(int a, int b, const Vector3d& point) const {
  const SurfaceTag& left = tags_[leftOf(a, b)];
  const SurfaceTag& right = tags_[leftOf(b, a)];
  return left == right ? original_.onRegion(left.region, point)
                       : original_.onFeature(left, right, point);
}

double SurfaceEditor::sag(int a, int b) const {
  const Vector3d middle = 0.5 * (positions_[a] + positions_[b]);
  return (onOriginal(a, b, middle) - middle).norm();
}

/// True if the edge to–other, which replaces from–other, would cut off too much of the surface.
bool SurfaceEditor::wouldSag(int from, int to, int other) const {
  const double longer = length(to, other);
  if (longer <= length(from, other)) return false;
  const Vector3d middle = 0.5 * (positions_[to] + positions_[other]);
  return (onOriginal(from, other, middle) - middle).norm() > kMaxCollapseSag * longer;
}

bool SurfaceEditor::isFlat(int node) const {
  Vector3d sum = Vector3d::Zero();
  for (int t : around_[node]) sum += normal(triangles_[t]);
  return std::all_of(around_[node].begin(), around_[node].end(),
                     [&](int t) { return cosineBetween(normal(triangles_[t]), sum) > kFlatStar; });
}

bool SurfaceEditor::starStays(int node, const Vector3d& there) const {
  return std::all_of(around_[node].begin(), around_[node].end(), [&](int t) {
    const Vector3d before = normal(triangles_[t]);
    // A triangle without area has no orientation to preserve.
    return before.norm() == 0.0 ||
           cosineBetween(before, normalWith(triangles_[t], node, there)) > kSameSide;
  });
}

double SurfaceEditor::worstAngleCosine(int node) const {
  double worst = -1.0;
  for (int t : around_[node]) worst = std::max(worst, smallestAngleCosine(t));
  return worst;
}

void SurfaceEditor::replace(int triangle, const std::array<int, 3>& nodes) {
  for (int old : triangles_[triangle])
    if (std::find(nodes.begin(), nodes.end(), old) == nodes.end())
      std::erase(around_[old], triangle);
  for (int fresh : nodes)
    if (std::find(triangles_[triangle].begin(), triangles_[triangle].end(), fresh) ==
        triangles_[triangle].end())
      around_[fresh].push_back(triangle);
  triangles_[triangle] = nodes;
}

void SurfaceEditor::split(int a, int b) {
  const Vector3d middle = 0.5 * (positions_[a] + positions_[b]);
  const Vector3d there = onOriginal(a, b, middle);
  const std::array<std::pair<int, int>, 2> halves{{{leftOf(a, b), b}, {leftOf(b, a), a}}};
  const int fresh = nodeCount();
  positions_.push_back(middle);
  sizes_.push_back(0.0);
  corner_.push_back(false);
  around_.emplace_back();
  for (const auto& [t, end] : halves) {
    // (start, end, apex) becomes (start, fresh, apex) and (fresh, end, apex).
    const std::array<int, 3> old = triangles_[t];
    std::array<int, 3> first = old;
    std::array<int, 3> second = old;
    const int start = end == b ? a : b;
    for (int k = 0; k < 3; ++k) {
      if (old[k] == end) first[k] = fresh;
      if (old[k] == start) second[k] = fresh;
    }
    replace(t, first);
    const int added = triangleCount();
    triangles_.push_back(second);
    tags_.push_back(tags_[t]);
    for (int node : second) around_[node].push_back(added);
  }
  if ((there - middle).norm() < kFarOff * length(a, b) && starStays(fresh, there))
    positions_[fresh] = there;
  sizes_[fresh] = field_.at(positions_[fresh]);
}

bool SurfaceEditor::mayCollapse(int from, int to) const {
  if (corner_[from]) return false;
  const int left = leftOf(from, to);
  const int right = leftOf(to, from);
  const std::vector<int> rails = featureNeighbours(from);
  if (!rails.empty() && tags_[left] == tags_[right]) return false;
  const std::vector<int> mine = neighbours(from);
  const std::vector<int> others = neighbours(to);
  std::vector<int> common;
  std::set_intersection(mine.begin(), mine.end(), others.begin(), others.end(),
                        std::back_inserter(common));
  // Link condition: otherwise the surface would touch itself.
  if (common.size() != 2) return false;
  for (int apex : common) {
    if (around_[apex].size() <= 3) return false;
    // A triangle with three feature edges is the only triangle of its tag.
    if (!rails.empty() && isFeature(from, apex) && isFeature(to, apex)) return false;
    if (!rails.empty() && rails[0] != to && rails[1] != to) return false;
  }
  const bool flat = isFlat(from);
  for (int other : mine) {
    constexpr double kMaxLengthRatio = 4.0 / 3.0;
    if (other != to && length(other, to) > kMaxLengthRatio * 0.5 * (sizes_[other] + sizes_[to]) &&
        length(other, to) > length(other, from))
      return false;
    if (!flat && other != to && wouldSag(from, to, other)) return false;
  }
  double worst = -1.0;
  for (int t : around_[from]) {
    if (t == left || t == right) continue;
    const Vector3d before = normal(triangles_[t]);
    const Vector3d after = normalWith(triangles_[t], from, positions_[to]);
    if (after.norm() == 0.0 || (before.norm() > 0.0 && cosineBetween(before, after) < kSameSide))
      return false;
    std::array<Vector3d, 3> p;
    for (int k = 0; k < 3; ++k)
      p[k] = triangles_[t][k] == from ? positions_[to] : positions_[triangles_[t][k]];
    worst = std::max({worst, cornerCosine(p[0], p[1], p[2]), cornerCosine(p[1], p[2], p[0]),
                      cornerCosine(p[2], p[0], p[1])});
  }
  constexpr double kSliver = 0.9962;  // 5°
  return worst <= kSliver || worst <= worstAngleCosine(from);
}

bool SurfaceEditor::collapse(int from, int to) {
  if (!mayCollapse(from, to)) return false;
  for (int t : {leftOf(from, to), leftOf(to, from)}) {
    for (int node : triangles_[t]) std::erase(around_[node], t);
    triangles_[t] = {-1, -1, -1};
  }
  const std::vector<int> moved = around_[from];
  for (int t : moved) {
    std::array<int, 3> n = triangles_[t];
    std::replace(n.begin(), n.end(), from, to);
    replace(t, n);
  }
  return true;
}

bool SurfaceEditor::flip(int a, int b) {
  const int left = leftOf(a, b);
  const int right = leftOf(b, a);
  if (tags_[left] != tags_[right]) return false;
  const auto apexOf = [&](int t) {
    for (int node : triangles_[t])
      if (node != a && node != b) return node;
    return -1;
  };
  const int c = apexOf(left);
  const int d = apexOf(right);
  if (c == d || leftOf(c, d) >= 0) return false;
  const std::array<int, 3> first{a, d, c};
  const std::array<int, 3> second{d, b, c};
  const Vector3d sum = normal(triangles_[left]) + normal(triangles_[right]);
  const double bend = cosineBetween(normal(first), normal(second));
  constexpr double kFlat = 0.8;
  if (cosineBetween(normal(first), sum) < kSameSide ||
      cosineBetween(normal(second), sum) < kSameSide ||
      bend < std::min(kFlat, cosineBetween(normal(triangles_[left]), normal(triangles_[right]))))
    return false;
  const auto angle = [&](const std::array<int, 3>& n) {
    return std::max({cornerCosine(positions_[n[0]], positions_[n[1]], positions_[n[2]]),
                     cornerCosine(positions_[n[1]], positions_[n[2]], positions_[n[0]]),
                     cornerCosine(positions_[n[2]], positions_[n[0]], positions_[n[1]])});
  };
  constexpr double kGain = 1.001;  // of 1 - cosine; rounding must not cause endless flips
  if (1.0 - std::max(angle(first), angle(second)) <
      kGain * (1.0 - std::max(smallestAngleCosine(left), smallestAngleCosine(right))))
    return false;
  if (bend < kFlatStar) {
    const auto sagOf = [&](int from, int to) {
      const Vector3d middle = 0.5 * (positions_[from] + positions_[to]);
      return (onOriginal(a, b, middle) - middle).norm();
    };
    const double shortest =
        std::min({length(a, c), length(c, b), length(b, d), length(d, a), length(c, d)});
    if (sagOf(c, d) > std::max(sagOf(a, b), kMaxCollapseSag * shortest)) return false;
  }
  replace(left, first);
  replace(right, second);
  return true;
}

}  // namespace palpa::modeling

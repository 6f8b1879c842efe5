#include "modeling/mesh/section_outline.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using OutlinePoint = PlaneSection::OutlinePoint;

/// Neighbours nearer than this share of the mean distance are merged …
constexpr double kMinSpacing = 0.35;
/// … unless the line turns by more than this angle, rad …
constexpr double kCorner = 0.35;
/// … and they are not nearer than this share.
constexpr double kSamePoint = 0.02;

/// Numbers of the distinct positions of crossed triangles, equal up to rounding: tessellations of
/// neighbouring patches differ in their last bits.
class Welding {
 public:
  explicit Welding(double size) : step_(1e-9 * size) {}
  int of(const Vector3d& position) {
    std::array<long long, 3> key{};
    for (int k = 0; k < 3; ++k)
      key[static_cast<std::size_t>(k)] = std::llround(position[k] / step_);
    return numbers_.emplace(key, static_cast<int>(numbers_.size())).first->second;
  }

 private:
  double step_;
  std::map<std::array<long long, 3>, int> numbers_;
};

struct Crossing {
  Vector3d position;
  OutlinePoint point;
};

/// Where the edge between two vertices on different sides crosses the plane; the same to the last
/// bit from both sides of the edge.
Crossing crossing(const std::vector<Vector3d>& positions, const std::vector<double>& distances,
                  int behind, int inFront) {
  const double d0 = distances[static_cast<std::size_t>(behind)],
               d1 = distances[static_cast<std::size_t>(inFront)];
  const double t = d0 / (d0 - d1);
  return {(1 - t) * positions[static_cast<std::size_t>(behind)] +
              t * positions[static_cast<std::size_t>(inFront)],
          {{behind, inFront, behind, behind}, {1 - t, t, 0, 0}}};
}

double turn(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d in = b - a, out = c - b;
  return std::atan2(in.cross(out).norm(), in.dot(out));
}

/// Merges points that lie close together.
SectionLoop thinned(const SectionLoop& loop) {
  const std::size_t count = loop.positions.size();
  double perimeter = 0;
  for (std::size_t k = 0; k < count; ++k)
    perimeter += (loop.positions[(k + 1) % count] - loop.positions[k]).norm();
  const double mean = perimeter / static_cast<double>(count);
  SectionLoop kept;
  const auto isDropped = [&](std::size_t k, const Vector3d& before, const Vector3d& after) {
    const Vector3d& at = loop.positions[k];
    const double distance = (at - before).norm();
    return distance <= kSamePoint * mean ||
           (distance < kMinSpacing * mean && turn(before, at, after) < kCorner);
  };
  for (std::size_t k = 0; k < count; ++k) {
    if (!kept.positions.empty() &&
        isDropped(k, kept.positions.back(), loop.positions[(k + 1) % count]))
      continue;
    kept.positions.push_back(loop.positions[k]);
    kept.points.push_back(loop.points[k]);
  }
  // The first point is the last one's neighbour, too.
  while (kept.positions.size() > 1 &&
         (kept.positions.front() - kept.positions.back()).norm() <= kSamePoint * mean) {
    kept.positions.pop_back();
    kept.points.pop_back();
  }
  return kept;
}

}  // namespace

std::vector<SectionLoop> sectionOutline(const std::vector<Vector3d>& positions,
                                        const std::vector<std::array<int, 3>>& triangles,
                                        const Plane& plane) {
  std::vector<double> distances;
  distances.reserve(positions.size());
  for (const Vector3d& x : positions) distances.push_back(plane.distance(x));
  // A plane that only touches the body does not cut it.
  double size = 0;
  for (const double distance : distances) size = std::max(size, std::abs(distance));
  const double slack = 1e-12 * size;
  if (std::none_of(distances.begin(), distances.end(), [&](double d) { return d < -slack; }) ||
      std::none_of(distances.begin(), distances.end(), [&](double d) { return d > slack; }))
    return {};
  const auto isInFront = [&](int vertex) {
    return distances[static_cast<std::size_t>(vertex)] >= 0;
  };

  // A line enters and leaves a triangle through two of its edges. Edges are named by the distinct
  // positions of their ends.
  Welding welding(size);
  using Edge = std::pair<int, int>;
  const auto edgeOf = [&](int behind, int inFront) {
    return Edge(welding.of(positions[static_cast<std::size_t>(behind)]),
                welding.of(positions[static_cast<std::size_t>(inFront)]));
  };
  std::map<Edge, std::pair<Edge, Crossing>> next;  // from an edge: to the next, starting there
  for (const auto& triangle : triangles) {
    int single = -1;
    for (int k = 0; k < 3; ++k)
      if (isInFront(triangle[k]) != isInFront(triangle[(k + 1) % 3]) &&
          isInFront(triangle[k]) != isInFront(triangle[(k + 2) % 3]))
        single = k;
    if (single < 0) continue;
    const int one = triangle[single], after = triangle[(single + 1) % 3],
              before = triangle[(single + 2) % 3];
    // With outward triangles the body lies on the left of a line that enters through the edge
    // after a corner in front.
    const auto cut = [&](int a, int b) { return isInFront(a) ? std::pair(b, a) : std::pair(a, b); };
    const auto first = isInFront(one) ? cut(one, before) : cut(one, after);
    const auto second = isInFront(one) ? cut(one, after) : cut(one, before);
    next.emplace(edgeOf(first.first, first.second),
                 std::pair(edgeOf(second.first, second.second),
                           crossing(positions, distances, first.first, first.second)));
  }

  std::vector<SectionLoop> loops;
  while (!next.empty()) {
    SectionLoop loop;
    const Edge start = next.begin()->first;
    Edge at = start;
    bool isClosed = false;
    for (auto found = next.find(at); found != next.end(); found = next.find(at)) {
      loop.positions.push_back(found->second.second.position);
      loop.points.push_back(found->second.second.point);
      at = found->second.first;
      next.erase(found);
      isClosed = at == start;
      if (isClosed) break;
    }
    if (!isClosed || loop.positions.size() < 3) continue;
    loop = thinned(loop);
    if (loop.positions.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace palpa::modeling

#include "modeling/mesh/small_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "base/disjoint_sets.h"
#include "modeling/body/closed_surfaces.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/part_removal.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

/// What the chains of edges about a part are like.
enum class Kind { kPin, kHole };

constexpr double kMaxExtent = 2;            // of chains, in smallest lengths
constexpr double kMaxAreaPerLength = 5;     // of parts, in smallest lengths: a square pin has 4
constexpr double kMaxShareOfVolume = 0.05;  // of one part
constexpr std::size_t kMaxLoops = 2;        // of a hole: a through hole has two

/// Closed chains of directed edges; none if a vertex is on two of them.
std::optional<std::vector<std::vector<int>>> loopsOf(const std::map<int, int>& next,
                                                     std::size_t edges) {
  if (next.size() != edges) return std::nullopt;
  std::vector<std::vector<int>> loops;
  std::set<int> used;
  for (const auto& [first, second] : next) {
    if (used.contains(first)) continue;
    std::vector<int> loop;
    for (int vertex = first; used.insert(vertex).second; vertex = next.at(vertex)) {
      loop.push_back(vertex);
      if (!next.contains(next.at(vertex))) return std::nullopt;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// One pass over a surface.
class Search {
 public:
  Search(const FacedTriangles& surface, const LengthAt& smallest, const std::set<int>& keptFaces,
         Kind kind)
      : surface_(surface),
        smallest_(smallest),
        keptFaces_(keptFaces),
        kind_(kind),
        neighbours_(triangleNeighbours(surface.triangles)) {
    const auto& p = surface.positions;
    for (const int t : reliableTriangles(p, surface.triangles, neighbours_)) {
      const auto& [a, b, c] = surface.triangles[t];
      normals_.push_back((p[b] - p[a]).cross(p[c] - p[a]).normalized());
    }
    volume_ = volumeOf(allTriangles(), p.front());
  }

  /// Small parts that do not touch each other.
  std::vector<SurfacePart> find() const {
    DisjointSets sets = partsBetweenChains();
    // Of a thick pin with a thin tip only the tip is small.
    std::vector<SurfacePart> single;
    if (kind_ == Kind::kPin) single = collect(sets);
    joinSmallNeighbours(sets);
    std::vector<SurfacePart> found;
    std::vector<bool> isFound(surface_.triangles.size(), false);
    const auto take = [&](std::vector<SurfacePart> parts) {
      for (SurfacePart& part : parts) {
        if (isFound[part.triangles.front()] || !isSmall(part)) continue;
        for (const int t : part.triangles) isFound[t] = true;
        found.push_back(std::move(part));
      }
    };
    take(collect(sets));
    take(std::move(single));
    return found;
  }

 private:
  std::vector<int> allTriangles() const {
    std::vector<int> all(surface_.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  const Vector3d& at(int vertex) const { return surface_.positions[vertex]; }

  /// Sharp, and concave about pins, convex about holes.
  bool isChain(int t, int k) const {
    static const double sharp = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180);
    const int other = neighbours_[t][k];
    if (normals_[t].dot(normals_[other]) > sharp) return false;
    const Vector3d along = at(surface_.triangles[t][(k + 1) % 3]) - at(surface_.triangles[t][k]);
    const double convex = along.dot(normals_[t].cross(normals_[other]));
    return kind_ == Kind::kPin ? convex < 0 : convex > 0;
  }

  DisjointSets partsBetweenChains() const {
    DisjointSets sets(surface_.triangles.size());
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (neighbours_[t][k] > static_cast<int>(t) && !isChain(static_cast<int>(t), k))
          sets.join(static_cast<int>(t), neighbours_[t][k]);
    return sets;
  }

  /// Makes adjacent parts with small chains only one part, as a hole with its chamfer.
  void joinSmallNeighbours(DisjointSets& sets) const {
    const std::vector<SurfacePart> parts = collect(sets);
    const auto largest = std::max_element(parts.begin(), parts.end(),
                                          [&](const SurfacePart& one, const SurfacePart& other) {
                                            return areaOf(one) < areaOf(other);
                                          });
    std::vector<bool> isCandidate(surface_.triangles.size(), false);
    for (auto part = parts.begin(); part != parts.end(); ++part)
      if (part != largest && part->loops.size() <= kMaxLoops && hasSmallLoops(*part))
        for (const int t : part->triangles) isCandidate[t] = true;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      for (const int other : neighbours_[t])
        if (isCandidate[t] && isCandidate[other]) sets.join(static_cast<int>(t), other);
  }

  /// Parts with chains that are closed and pass each vertex once.
  std::vector<SurfacePart> collect(DisjointSets& sets) const {
    std::map<int, std::vector<int>> members;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      members[sets.rootOf(static_cast<int>(t))].push_back(static_cast<int>(t));
    std::vector<SurfacePart> parts;
    for (auto& [root, triangles] : members) {
      std::map<int, int> next;
      std::size_t edges = 0;
      for (const int t : triangles)
        for (int k = 0; k < 3; ++k)
          if (sets.rootOf(neighbours_[t][k]) != root) {
            next[surface_.triangles[t][k]] = surface_.triangles[t][(k + 1) % 3];
            ++edges;
          }
      auto loops = loopsOf(next, edges);
      if (loops && !loops->empty()) parts.push_back({std::move(triangles), std::move(*loops)});
    }
    return parts;
  }

  double smallestAt(const std::vector<int>& vertices) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int vertex : vertices) least = std::min(least, smallest_(at(vertex)));
    return least;
  }

  bool hasSmallLoops(const SurfacePart& part) const {
    return std::all_of(part.loops.begin(), part.loops.end(), [&](const std::vector<int>& loop) {
      return extentOf(loop, at(loop.front())) < kMaxExtent * smallestAt(loop);
    });
  }

  double extentOf(const std::vector<int>& vertices, const Vector3d& from) const {
    double extent = 0;
    for (const int vertex : vertices) extent = std::max(extent, (at(vertex) - from).norm());
    return extent;
  }

  /// Of the cones from an apex over triangles.
  double volumeOf(const std::vector<int>& triangles, const Vector3d& apex) const {
    double six = 0;
    for (const int t : triangles) {
      const auto& [a, b, c] = surface_.triangles[t];
      six += (at(a) - apex).dot((at(b) - apex).cross(at(c) - apex));
    }
    return six / 6;
  }

  bool isSmall(const SurfacePart& part) const {
    if (part.loops.size() > (kind_ == Kind::kPin ? 1 : kMaxLoops) || !hasSmallLoops(part))
      return false;
    std::vector<int> vertices;
    for (const int t : part.triangles) {
      if (keptFaces_.contains(surface_.faceOfTriangle[t])) return false;
      const Triangle& corners = surface_.triangles[t];
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    const double area = areaOf(part);
    const Vector3d apex = centreOf(part.loops.front());
    // The ends' cones: each is a fan about its own centre, opposite to the part's direction.
    double volume = volumeOf(part.triangles, apex);
    for (const std::vector<int>& loop : part.loops) {
      const Vector3d centre = centreOf(loop);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector3d a = at(loop[i]), b = at(loop[(i + 1) % loop.size()]);
        volume += (centre - apex).dot((b - apex).cross(a - apex)) / 6;
      }
    }
    if (kind_ == Kind::kHole) volume = -volume;
    const double smallest = smallestAt(vertices);
    return volume > 0 && volume < kMaxShareOfVolume * volume_ && 4 * volume < smallest * area &&
           area < kMaxAreaPerLength * smallest * extentOf(vertices, apex);
  }

  double areaOf(const SurfacePart& part) const {
    double area = 0;
    for (const int t : part.triangles) {
      const auto& [a, b, c] = surface_.triangles[t];
      area += (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
    }
    return area;
  }

  Vector3d centreOf(const std::vector<int>& loop) const {
    Vector3d sum = Vector3d::Zero();
    for (const int vertex : loop) sum += at(vertex);
    return sum / static_cast<double>(loop.size());
  }

  const FacedTriangles& surface_;
  const LengthAt& smallest_;
  const std::set<int>& keptFaces_;
  Kind kind_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Vector3d> normals_;
  double volume_ = 0;
};

/// Removes the parts from the surface, or none of them if that would leave a cavity: narrow holes
/// may lead into wide ones. Returns the number of removed parts.
int removeParts(const std::vector<SurfacePart>& parts, const std::set<int>& keptFaces,
                FacedTriangles& surface) {
  if (parts.empty()) return 0;
  PartRemoval removal(surface, keptFaces);
  int count = 0;
  for (const SurfacePart& part : parts) count += removal.remove(part) ? 1 : 0;
  FacedTriangles left = removal.result();
  if (closedSurfaceCount(left.triangles) > closedSurfaceCount(surface.triangles)) return 0;
  surface = std::move(left);
  return count;
}

}  // namespace

WithoutSmallParts withoutSmallParts(FacedTriangles surface, const LengthAt& smallest,
                                    const std::set<int>& keptFaces, const Job& job) {
  constexpr int kRounds = 4;  // pins on pins
  WithoutSmallParts result{std::move(surface), 0, 0};
  for (int round = 0; round < kRounds; ++round) {
    const int before = result.pins + result.holes;
    for (const Kind kind : {Kind::kPin, Kind::kHole}) {
      job.throwIfCancelled();
      std::vector<SurfacePart> parts = Search(result.surface, smallest, keptFaces, kind).find();
      const auto isBlind = [](const SurfacePart& part) { return part.loops.size() == 1; };
      int removed = removeParts(parts, keptFaces, result.surface);
      // Blind holes alone cannot leave a cavity.
      if (removed == 0 && std::erase_if(parts, std::not_fn(isBlind)) > 0)
        removed = removeParts(parts, keptFaces, result.surface);
      (kind == Kind::kPin ? result.pins : result.holes) += removed;
    }
    if (result.pins + result.holes == before) break;
  }
  return result;
}

}  // namespace palpa::modeling

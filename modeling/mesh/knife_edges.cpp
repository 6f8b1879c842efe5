#include "modeling/mesh/knife_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "modeling/body/closed_surfaces.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/surface_boolean.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

const double kKnife = std::cos(20 * std::numbers::pi / 180);        // of the angle within the body
const double kChainCorner = std::cos(30 * std::numbers::pi / 180);  // of a chain, between its edges
constexpr double kMinDepth = 2.5, kMaxDepth = 12;                   // of a cut, in thinnest lengths
constexpr double kDepthFactor = 1.2;                                // between depths that are tried
constexpr double kHalfWidth = 0.8;  // of a bar: both sides of the edge need not be plane
constexpr double kAside = 0.03;     // of the corners of a bar, along the edge
constexpr double kBeyond = 0.1;     // of a bar beyond the edge and its ends
constexpr std::size_t kMaxChains = 100;

struct KnifeEdge {
  std::array<int, 2> ends;
  Vector3d inward;  ///< unit, between both sides
  Vector3d across;  ///< unit, from one side to the other
  double depth;     ///< mm, where the body is as thick as wanted
};

class KnifeEdges {
 public:
  KnifeEdges(const FacedTriangles& surface, double thinnest, const std::set<int>& keptFaces)
      : surface_(surface), thinnest_(thinnest), neighbours_(triangleNeighbours(surface.triangles)) {
    const std::vector<int> reliable =
        reliableTriangles(surface.positions, surface.triangles, neighbours_);
    for (const int t : reliable) normals_.push_back(areaVector(t).normalized());
    for (std::size_t t = 0; t < normals_.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int other = neighbours_[t][k];
        if (other < static_cast<int>(t)) continue;
        if (keptFaces.contains(surface.faceOfTriangle[t]) ||
            keptFaces.contains(surface.faceOfTriangle[other]))
          continue;
        if (const auto edge = edgeBetween(static_cast<int>(t), other, k)) {
          for (const int end : edge->ends) edgesAt_[end].push_back(static_cast<int>(edges_.size()));
          edges_.push_back(*edge);
        }
      }
  }

  /// Closed bars that contain the knife edges, one for each chain.
  std::vector<FacedTriangles> bars() const {
    std::vector<FacedTriangles> bars;
    std::vector<bool> isUsed(edges_.size(), false);
    // Chains begin at their ends, closed ones anywhere.
    for (const bool fromEnds : {true, false})
      for (std::size_t e = 0; e < edges_.size() && bars.size() < kMaxChains; ++e)
        for (const int start : edges_[e].ends) {
          if (isUsed[e] || (fromEnds && next(static_cast<int>(e), start))) continue;
          const std::vector<int> chain = chainFrom(static_cast<int>(e), start, isUsed);
          if (length(chain) > thinnest_) bars.push_back(barAlong(chain, start));
        }
    return bars;
  }

 private:
  Vector3d areaVector(int t) const {
    const auto& [a, b, c] = surface_.triangles[t];
    return (at(b) - at(a)).cross(at(c) - at(a));
  }
  const Vector3d& at(int vertex) const { return surface_.positions[vertex]; }
  int otherEnd(int edge, int end) const {
    return edges_[edge].ends[edges_[edge].ends[0] == end ? 1 : 0];
  }
  double length(const std::vector<int>& chain) const {
    double sum = 0;
    for (const int e : chain) sum += (at(edges_[e].ends[1]) - at(edges_[e].ends[0])).norm();
    return sum;
  }

  /// The edge after corner k of triangle t, if it is a knife edge.
  std::optional<KnifeEdge> edgeBetween(int t, int other, int k) const {
    const int a = surface_.triangles[t][k], b = surface_.triangles[t][(k + 1) % 3];
    const Vector3d along = (at(b) - at(a)).normalized();
    const Vector3d into = normals_[t].cross(along), intoOther = along.cross(normals_[other]);
    // Of a crevice, the other side is in front of this one.
    if (into.dot(intoOther) < kKnife || normals_[t].dot(intoOther) >= 0) return std::nullopt;
    KnifeEdge edge{{a, b}, (into + intoOther).normalized(), {}, 0};
    edge.across = along.cross(edge.inward);
    if (!walls_) walls_.emplace(surface_.positions, surface_.triangles);
    const Vector3d middle = (at(a) + at(b)) / 2;
    const auto thickness = [&](double depth) {
      const Vector3d x = middle + depth * edge.inward;
      return walls_->distanceAlong(x, edge.across, -1) + walls_->distanceAlong(x, -edge.across, -1);
    };
    const double room =
        walls_->distanceAlong(middle + kBeyond * thinnest_ * edge.inward, edge.inward, -1);
    if (!(thickness(thinnest_) < thinnest_ / 2)) return std::nullopt;  // of a fold
    edge.depth = kMinDepth * thinnest_;
    while (edge.depth < kMaxDepth * thinnest_ && thickness(edge.depth) < thinnest_)
      edge.depth *= kDepthFactor;
    // A ridge that is thin everywhere would be cut in two.
    if (!(room > edge.depth)) return std::nullopt;
    return edge;
  }

  /// The edge that continues a chain beyond an end of an edge.
  std::optional<int> next(int edge, int end) const {
    const std::vector<int>& others = edgesAt_.at(end);
    if (others.size() != 2) return std::nullopt;
    const int other = others[0] == edge ? others[1] : others[0];
    const Vector3d before = (at(end) - at(otherEnd(edge, end))).normalized();
    const Vector3d after = (at(otherEnd(other, end)) - at(end)).normalized();
    if (before.dot(after) < kChainCorner) return std::nullopt;
    return other;
  }

  std::vector<int> chainFrom(int first, int start, std::vector<bool>& isUsed) const {
    std::vector<int> chain{first};
    isUsed[first] = true;
    int end = otherEnd(first, start);
    for (auto other = next(first, end); other && !isUsed[*other]; other = next(chain.back(), end)) {
      chain.push_back(*other);
      isUsed[*other] = true;
      end = otherEnd(*other, end);
    }
    return chain;
  }

  /// Cross-section of a bar: at the edge and, `depth` below it, on both sides.
  std::array<Vector3d, 4> section(const Vector3d& center, const Vector3d& inward,
                                  const Vector3d& across, double depth) const {
    const Vector3d side = kHalfWidth * thinnest_ * across;
    const Vector3d top = center - kBeyond * thinnest_ * inward;
    const Vector3d bottom = center + depth * inward;
    return {top + side, top - side, bottom - side, bottom + side};
  }

  struct Station {
    Vector3d position, inward = Vector3d::Zero(), across = Vector3d::Zero(),
                       along = Vector3d::Zero();
    double depth = 0;
  };

  /// True if the body ends there, and not beside a wall or because the edge becomes blunt.
  bool isFree(int vertex, const Vector3d& outward) const {
    constexpr double kFacing = 0.5;
    for (std::size_t t = 0; t < normals_.size(); ++t) {
      const Triangle& corners = surface_.triangles[t];
      if (std::find(corners.begin(), corners.end(), vertex) != corners.end() &&
          normals_[t].dot(outward) > kFacing)
        return true;
    }
    return false;
  }

  /// Lets a bar begin outside of the body, or, at the last edge that is cut, in front of the edge,
  /// from where it becomes as deep as it is long: grooves and ribs at its end would be tiny.
  void shapeBegin(std::vector<Station>& stations, int vertex) const {
    Station& first = stations[0];
    const Vector3d along = stations[1].position - first.position;
    const Vector3d reach = kBeyond * thinnest_ * along.normalized();
    if (isFree(vertex, -along.normalized())) {
      first.position -= reach;
      return;
    }
    Station deep = first;
    deep.position += first.depth * along.normalized();
    first.position += reach;
    first.depth = -kBeyond / 2 * thinnest_;
    if (along.norm() > 1.5 * deep.depth) stations.insert(stations.begin() + 1, deep);
    double distance = 0;
    for (std::size_t i = 1; i < stations.size(); ++i) {
      distance += (stations[i].position - stations[i - 1].position).norm();
      stations[i].depth = std::min(stations[i].depth, distance);
    }
  }

  FacedTriangles barAlong(const std::vector<int>& chain, int start) const {
    const int begin = start;
    std::vector<Station> stations{{at(start)}};
    for (const int e : chain) {
      const KnifeEdge& edge = edges_[e];
      const int from = std::exchange(start, otherEnd(e, start));
      stations.push_back({at(start)});
      for (Station* end : {&stations[stations.size() - 2], &stations.back()}) {
        end->inward += edge.inward;
        end->along += (at(start) - at(from)).normalized();
        end->across += (end->across.dot(edge.across) < 0 ? -1 : 1) * edge.across;
        end->depth = std::max(end->depth, edge.depth);
      }
    }
    const bool isClosed = chain.size() > 2 && stations.front().position == stations.back().position;
    if (isClosed) {
      Station& first = stations.front();
      const Station& last = stations.back();
      first.inward += last.inward;
      first.along += last.along;
      first.across += (first.across.dot(last.across) < 0 ? -1 : 1) * last.across;
      first.depth = std::max(first.depth, last.depth);
      stations.pop_back();
    } else {
      shapeBegin(stations, begin);
      std::reverse(stations.begin(), stations.end());
      shapeBegin(stations, start);
    }
    FacedTriangles bar;
    Vector3d across = stations.front().across;
    // Slightly aside: edges of the surface often begin at the knife edge's vertices, and where
    // edges meet by chance, rounding makes surfaces cut through themselves.
    for (const Station& station : stations) {
      across = (station.across.dot(across) < 0 ? -1 : 1) * station.across.normalized();
      for (const Vector3d& corner :
           section(station.position + kAside * thinnest_ * station.along.normalized(),
                   station.inward.normalized(), across, station.depth))
        bar.positions.push_back(corner);
    }
    const int n = static_cast<int>(stations.size());
    for (int i = 0; i < (isClosed ? n : n - 1); ++i)
      for (int k = 0; k < 4; ++k) {
        const int a = 4 * i + k, b = 4 * i + (k + 1) % 4, c = 4 * ((i + 1) % n) + (k + 1) % 4,
                  d = 4 * ((i + 1) % n) + k;
        bar.triangles.push_back({a, b, c});
        bar.triangles.push_back({a, c, d});
      }
    if (!isClosed) {
      const int last = 4 * (n - 1);
      bar.triangles.insert(
          bar.triangles.end(),
          {{{0, 3, 2}}, {{0, 2, 1}}, {{last, last + 1, last + 2}}, {{last, last + 2, last + 3}}});
    }
    if (enclosedVolume(bar) < 0)
      for (auto& triangle : bar.triangles) std::swap(triangle[1], triangle[2]);
    return bar;
  }

  static double enclosedVolume(const FacedTriangles& solid) {
    double sum = 0;
    const Vector3d& origin = solid.positions.front();
    for (const auto& [a, b, c] : solid.triangles)
      sum += (solid.positions[a] - origin)
                 .dot((solid.positions[b] - origin).cross(solid.positions[c] - origin));
    return sum / 6;
  }

  const FacedTriangles& surface_;
  double thinnest_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Vector3d> normals_;
  mutable std::optional<NearestOnTriangles>
      walls_;  ///< made for the first edge: most bodies have none
  std::vector<KnifeEdge> edges_;
  std::map<int, std::vector<int>> edgesAt_;  ///< by vertex
};

FacedTriangles joined(const std::vector<FacedTriangles>& solids) {
  FacedTriangles all;
  for (const FacedTriangles& solid : solids) {
    const int first = static_cast<int>(all.positions.size());
    all.positions.insert(all.positions.end(), solid.positions.begin(), solid.positions.end());
    for (const auto& [a, b, c] : solid.triangles)
      all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

}  // namespace

WithoutKnifeEdges withoutKnifeEdges(FacedTriangles surface, double thinnest,
                                    const std::set<int>& keptFaces, const Job& job) {
  WithoutKnifeEdges result{std::move(surface), 0};
  if (!(thinnest > 0)) return result;
  const std::vector<FacedTriangles> bars = KnifeEdges(result.surface, thinnest, keptFaces).bars();
  if (bars.empty()) return result;
  job.throwIfCancelled();
  FacedTriangles cut = result.surface;
  // All at once is faster, but fails if two bars meet.
  if (auto left = differenceOf(cut, joined(bars))) {
    cut = std::move(*left);
    result.edges = static_cast<int>(bars.size());
  } else {
    for (const FacedTriangles& bar : bars) {
      job.throwIfCancelled();
      left = differenceOf(cut, bar);
      if (!left) continue;
      cut = std::move(*left);
      ++result.edges;
    }
  }
  if (result.edges == 0) return result;
  if (cut.triangles.empty() || cutsThroughItself(cut) ||
      closedSurfaceCount(cut.triangles) > closedSurfaceCount(result.surface.triangles)) {
    result.edges = 0;
    return result;
  }
  takeFaces(cut, result.surface);
  result.surface = std::move(cut);
  return result;
}

}  // namespace palpa::modeling

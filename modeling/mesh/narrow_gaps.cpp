#include "modeling/mesh/narrow_gaps.h"

#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "modeling/body/closed_surfaces.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/divided_triangles.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/surface_boolean.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

using Triangle = std::array<int, 3>;

constexpr double kPiece = 5;      // largest edge of the pieces of triangles, in narrowest lengths
constexpr double kFacing = -0.7;  // cosine of the normals on both sides of a gap
constexpr double kWall = -0.3;    // cosine of a wall's normal and the direction to it
constexpr double kNoDirection = 0.1;  // length of a sum of unit vectors that nearly cancel
constexpr double kOverlap = 0.1;      // of the width: how far a plate reaches into the surface
constexpr std::size_t kMaxPieces = 400'000;
constexpr std::size_t kMaxGaps = 200;

Vector3d areaVector(const FacedTriangles& of, std::size_t t) {
  const auto& [a, b, c] = of.triangles[t];
  return (of.positions[b] - of.positions[a]).cross(of.positions[c] - of.positions[a]);
}

/// True if some triangles face each other at less than `narrowest`, seen from their planes. Most
/// bodies have none, and need not be divided.
bool mayHaveGaps(const FacedTriangles& surface, double narrowest) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> boxes;
  std::vector<Vector3d> normals;
  const auto corner = [&](std::size_t t, int k) -> const Vector3d& {
    return surface.positions[surface.triangles[t][k]];
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    normals.push_back(areaVector(surface, t).normalized());
    const Vector3d reach = Vector3d::Constant(narrowest / 2);
    const Vector3d low = corner(t, 0).cwiseMin(corner(t, 1)).cwiseMin(corner(t, 2)) - reach;
    const Vector3d high = corner(t, 0).cwiseMax(corner(t, 1)).cwiseMax(corner(t, 2)) + reach;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), t);
  }
  // One of the corners of `other`: a small triangle beside a large, tilted one.
  const auto isCloseAbove = [&](std::size_t t, std::size_t other) {
    for (int k = 0; k < 3; ++k) {
      const double height = normals[t].dot(corner(other, k) - corner(t, 0));
      if (height > 0 && height < narrowest) return true;
    }
    return false;
  };
  bool found = false;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& boxA, const Box& boxB) {
    const std::size_t a = boxA.info(), b = boxB.info();
    if (!found && normals[a].dot(normals[b]) < kFacing)
      found = isCloseAbove(a, b) || isCloseAbove(b, a);
  });
  return found;
}

/// The gaps of a surface, as sets of pieces of the surface on one side.
class Gaps {
 public:
  Gaps(const FacedTriangles& surface, FacedTriangles pieces, double narrowest,
       const std::set<int>& keptFaces, const Job& job)
      : pieces_(std::move(pieces)), neighbours_(triangleNeighbours(pieces_.triangles)) {
    std::map<int, double> areas;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      areas[surface.faceOfTriangle[t]] += areaVector(surface, t).norm();
    for (std::size_t t = 0; t < pieces_.triangles.size(); ++t)
      normals_.push_back(areaVector(pieces_, t).normalized());
    const NearestOnTriangles all(pieces_.positions, pieces_.triangles);
    widths_.assign(pieces_.triangles.size(), 0);
    const std::vector<bool> isKept = besideFaces(keptFaces);
    for (std::size_t t = 0; t < widths_.size(); ++t) {
      if (t % 256 == 0) job.throwIfCancelled();
      if (isKept[t]) continue;
      const int face = pieces_.faceOfTriangle[t];
      const auto& [a, b, c] = pieces_.triangles[t];
      const Vector3d middle =
          (pieces_.positions[a] + pieces_.positions[b] + pieces_.positions[c]) / 3;
      const double width = all.distanceAlong(middle, normals_[t], static_cast<int>(t));
      if (!(width < narrowest)) continue;
      const int other = all.nearestTriangle(middle + width * normals_[t]);
      const int facing = pieces_.faceOfTriangle[other];
      if (isKept[other] || !(normals_[t].dot(normals_[other]) < kFacing)) continue;
      // One side is enough: the smaller one, whose border mostly is the mouth of the gap.
      if (std::pair(areas[face], face) <= std::pair(areas[facing], facing)) widths_[t] = width;
    }
  }

  /// Plates that fill the gaps, one for each smooth part of their side.
  std::vector<FacedTriangles> plates() const {
    std::vector<FacedTriangles> plates;
    std::vector<bool> isDone(widths_.size(), false);
    for (std::size_t t = 0; t < widths_.size() && plates.size() < kMaxGaps; ++t) {
      if (isDone[t] || widths_[t] == 0) continue;
      const std::vector<int> part = smoothPart(static_cast<int>(t), isDone);
      if (!part.empty()) plates.push_back(plateOver(part));
    }
    return plates;
  }

 private:
  /// The pieces of faces, and those with a vertex on one.
  std::vector<bool> besideFaces(const std::set<int>& faces) const {
    std::vector<bool> isVertexOf(pieces_.positions.size(), false);
    for (std::size_t t = 0; t < pieces_.triangles.size(); ++t)
      if (faces.contains(pieces_.faceOfTriangle[t]))
        for (const int vertex : pieces_.triangles[t]) isVertexOf[vertex] = true;
    std::vector<bool> isBeside;
    for (const Triangle& corners : pieces_.triangles)
      isBeside.push_back(std::any_of(corners.begin(), corners.end(),
                                     [&](int vertex) { return isVertexOf[vertex]; }));
    return isBeside;
  }

  std::vector<int> smoothPart(int first, std::vector<bool>& isDone) const {
    std::vector<int> part{first};
    isDone[first] = true;
    for (std::size_t k = 0; k < part.size(); ++k)
      for (const int other : neighbours_[part[k]]) {
        if (isDone[other] || widths_[other] == 0) continue;
        if (normals_[other].dot(normals_[part[k]]) < -kFacing) continue;
        isDone[other] = true;
        part.push_back(other);
      }
    removePinches(part);
    return part;
  }

  /// Removes the pieces at vertices where the border of the part touches itself: the plate would
  /// not be manifold there.
  void removePinches(std::vector<int>& part) const {
    for (bool isPinched = true; isPinched;) {
      const std::set<int> own(part.begin(), part.end());
      std::map<int, int> borderEdges;
      for (const int t : part)
        for (int k = 0; k < 3; ++k)
          if (!own.contains(neighbours_[t][k])) ++borderEdges[pieces_.triangles[t][k]];
      const auto isAtPinch = [&](int t) {
        const Triangle& corners = pieces_.triangles[t];
        return std::any_of(corners.begin(), corners.end(), [&](int vertex) {
          const auto edges = borderEdges.find(vertex);
          return edges != borderEdges.end() && edges->second > 1;
        });
      };
      isPinched = std::erase_if(part, isAtPinch) > 0;
    }
  }

  FacedTriangles plateOver(const std::vector<int>& part) const {
    struct Corner {
      int number = -1;
      Vector3d normal = Vector3d::Zero(), aside = Vector3d::Zero();
      double width = 0;
    };
    std::map<int, Corner> corners;
    const std::set<int> own(part.begin(), part.end());
    std::vector<std::pair<int, int>> border;
    double widest = 0;
    for (const int t : part) {
      widest = std::max(widest, widths_[t]);
      for (int k = 0; k < 3; ++k) {
        const int a = pieces_.triangles[t][k], b = pieces_.triangles[t][(k + 1) % 3];
        Corner& corner = corners[a];
        corner.normal += areaVector(pieces_, t);
        corner.width = std::max(corner.width, widths_[t]);
        const int other = neighbours_[t][k];
        if (own.contains(other)) continue;
        border.emplace_back(a, b);
        // Into a wall at the end of the gap; not quite to its mouth.
        const Vector3d outward =
            (pieces_.positions[b] - pieces_.positions[a]).cross(normals_[t]).normalized();
        const bool isWall = normals_[other].dot(outward) < kWall;
        for (const int end : {a, b}) corners[end].aside += (isWall ? 1 : -1) * outward;
      }
    }
    const double overlap = kOverlap * widest;
    FacedTriangles plate;
    for (const bool isFar : {false, true})
      for (auto& [vertex, corner] : corners) {
        if (!isFar) corner.number = static_cast<int>(plate.positions.size());
        const double along = isFar ? corner.width + overlap : -overlap;
        const double aside = corner.aside.norm();
        plate.positions.push_back(pieces_.positions[vertex] + along * corner.normal.normalized());
        if (aside > kNoDirection) plate.positions.back() += overlap / aside * corner.aside;
      }
    const int count = static_cast<int>(corners.size());
    const auto near = [&](int vertex) { return corners.at(vertex).number; };
    const auto far = [&](int vertex) { return near(vertex) + count; };
    for (const int t : part) {
      const auto& [a, b, c] = pieces_.triangles[t];
      plate.triangles.push_back({near(a), near(c), near(b)});
      plate.triangles.push_back({far(a), far(b), far(c)});
    }
    for (const auto& [a, b] : border) {
      plate.triangles.push_back({near(a), near(b), far(b)});
      plate.triangles.push_back({near(a), far(b), far(a)});
    }
    return plate;
  }

  FacedTriangles pieces_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Vector3d> normals_;
  std::vector<double> widths_;  ///< of the gap over each piece; 0 without one
};

}  // namespace

WithoutNarrowGaps withoutNarrowGaps(FacedTriangles surface, double narrowest,
                                    const std::set<int>& keptFaces, const Job& job) {
  WithoutNarrowGaps result{std::move(surface), 0};
  if (!(narrowest > 0) || !mayHaveGaps(result.surface, narrowest)) return result;
  auto pieces = dividedTriangles(result.surface, kPiece * narrowest, kMaxPieces);
  if (!pieces) return result;
  const std::vector<FacedTriangles> plates =
      Gaps(result.surface, std::move(*pieces), narrowest, keptFaces, job).plates();
  if (plates.empty()) return result;
  FacedTriangles filled = result.surface;
  int gaps = 0;
  for (const FacedTriangles& plate : plates) {
    job.throwIfCancelled();
    if (auto united = unionOf(filled, plate)) {
      filled = std::move(*united);
      ++gaps;
    }
  }
  if (gaps == 0 || cutsThroughItself(filled)) return result;
  if (closedSurfaceCount(filled.triangles) > closedSurfaceCount(result.surface.triangles))
    return result;
  takeFaces(filled, result.surface);
  return {std::move(filled), gaps};
}

}  // namespace palpa::modeling

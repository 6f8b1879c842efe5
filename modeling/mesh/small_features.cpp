#include "modeling/mesh/small_features.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/feature_lengths.h"
#include "modeling/mesh/knife_edges.h"
#include "modeling/mesh/narrow_gaps.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/short_edges.h"
#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kNarrow = 0.2;   // of the thinnest pins: the width of gaps and knife edges
constexpr double kUnmoved = 0.2;  // of the smallest length: fine curved surfaces made coarser

/// Largest distance of the vertices and middles of triangles and edges of one surface from another.
double distance(const std::vector<Vector3d>& positions,
                const std::vector<std::array<int, 3>>& triangles, const NearestOnTriangles& other) {
  double largest = 0;
  const auto add = [&](const Vector3d& x) {
    largest = std::max(largest, (other.nearest(x) - x).norm());
  };
  for (const Vector3d& x : positions) add(x);
  for (const auto& [a, b, c] : triangles) {
    add((positions[a] + positions[b] + positions[c]) / 3);
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      if (from < to) add((positions[from] + positions[to]) / 2);
  }
  return largest;
}

/// Keeps all features near crossings, or, if `farther`, near the triangles that cross.
void keepAt(const std::vector<TriangleCrossing>& crossings, bool farther,
            const SimplifiedSurface& surface, const FacedTriangles& body,
            std::vector<double>& lengths) {
  constexpr double kNear = 3;  // smallest lengths
  std::vector<std::array<Vector3d, 2>> places;
  for (const TriangleCrossing& crossing : crossings)
    for (const int t : {crossing.a, crossing.b})
      for (int k = 0; k < 3; ++k) {
        const Vector3d& corner = surface.positions[surface.triangles[t][k]];
        places.push_back({farther ? surface.positions[surface.triangles[t][(k + 1) % 3]]
                                  : Vector3d(0.5 * (corner + crossing.at)),
                          farther ? corner : crossing.at});
      }
  const NearestOnSegments near(places);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if (near.distance(body.positions[i]) < kNear * lengths[i]) lengths[i] = 0;
}

/// Number of parts between sharp edges.
int smoothParts(const std::vector<Vector3d>& positions,
                const std::vector<std::array<int, 3>>& triangles) {
  const std::vector<int> parts =
      smoothRegions(positions, triangles, 0, static_cast<int>(triangles.size()));
  return *std::max_element(parts.begin(), parts.end()) + 1;
}

/// True if edges are too short to belong to a fine triangulation of a smooth surface.
bool hasTinyEdges(const FacedTriangles& body, const LengthAt& smallest) {
  constexpr double kTiny = 0.03;  // of the smallest length
  const auto& p = body.positions;
  return std::any_of(body.triangles.begin(), body.triangles.end(), [&](const auto& triangle) {
    for (int k = 0; k < 3; ++k) {
      const Vector3d& a = p[triangle[k]];
      if ((p[triangle[(k + 1) % 3]] - a).norm() < kTiny * smallest(a)) return true;
    }
    return false;
  });
}

SimplifiedSurface unchanged(const MeshBody& body) {
  return {{body.positions(), body.triangles(), body.faceOfTriangle()}};
}

}  // namespace

SimplifiedSurface withoutSmallFeatures(const MeshBody& body, const LengthAt& smallest,
                                       const LengthAt& thinnest, const std::set<int>& keptFaces,
                                       ThinPlaces thin, const Job& job) {
  constexpr int kAttempts = 5;
  constexpr std::size_t kMaxCrossings = 1000;
  double limit = 0;
  for (const Vector3d& x : body.positions()) limit = std::max(limit, smallest(x));
  if (limit == 0) return unchanged(body);
  auto [whole, pins, holes] = withoutSmallParts(
      {body.positions(), body.triangles(), body.faceOfTriangle()}, thinnest, keptFaces, job);
  double narrow = 0;
  if (thin == ThinPlaces::kRemoved)
    for (const Vector3d& x : body.positions()) narrow = std::max(narrow, kNarrow * thinnest(x));
  auto [filled, gaps] = withoutNarrowGaps(std::move(whole), narrow, keptFaces, job);
  const auto [plain, knives] = withoutKnifeEdges(std::move(filled), narrow, keptFaces, job);
  std::vector<double> lengths = featureLengths(plain, smallest, job);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    job.throwIfCancelled();
    SimplifiedSurface surface{withoutShortEdges(plain, lengths, keptFaces, job)};
    const auto crossings =
        triangleCrossings(surface.positions, surface.triangles, kMaxCrossings, job);
    if (!crossings.empty()) {
      keepAt(crossings, attempt >= 2, surface, plain, lengths);
      continue;
    }
    surface.cutPins = pins + knives;
    surface.filledHoles = holes + gaps;
    const NearestOnTriangles before(plain.positions, plain.triangles);
    const NearestOnTriangles after(surface.positions, surface.triangles);
    surface.moved = std::max(distance(plain.positions, plain.triangles, after),
                             distance(surface.positions, surface.triangles, before));
    surface.isNeeded = surface.cutPins + surface.filledHoles > 0 || hasTinyEdges(plain, smallest) ||
                       surface.moved > kUnmoved * limit ||
                       smoothParts(surface.positions, surface.triangles) !=
                           smoothParts(plain.positions, plain.triangles);
    const std::set<int> left(surface.faceOfTriangle.begin(), surface.faceOfTriangle.end());
    surface.vanishedFaces = static_cast<int>(body.faceNames().size() - left.size());
    return surface;
  }
  return unchanged(body);
}

}  // namespace palpa::modeling

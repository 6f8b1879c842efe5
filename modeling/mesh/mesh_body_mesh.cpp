#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <variant>

#include "base/count_text.h"
#include "base/text.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_refine.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/mesh/quadratic_mesh.h"
#include "modeling/mesh/surface_cut.h"
#include "modeling/mesh/surface_remesher.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Details smaller than this fraction of the edge length get no sharp edge.
constexpr double kMinDetail = 1.0 / 8.0;
constexpr double kSnap = 0.05;  // of the edge length: sharp edges nearer to a border belong to it
/// Mean edge length after remeshing, of the requested length.
constexpr double kMeanEdge = 0.93;
/// Requested length of remeshed edges, of strokeEdge(): that is the largest length of bisected
/// edges, whose lengths vary more.
constexpr double kMeanOfLongest = 0.85;
/// Area per node over the squared mean edge length, measured; 0.87 for equilateral triangles.
constexpr double kAreaPerNode = 0.84;

TaggedSurface taggedSurface(const MeshBody& body, double edgeLength) {
  const double detail = kMinDetail * edgeLength;
  const std::vector<int> regions =
      smoothRegions(body.positions(), body.triangles(), detail * detail,
                    static_cast<int>(body.triangles().size()));
  TaggedSurface surface{body.positions(), body.triangles(), {}};
  const auto neighbours = triangleNeighbours(body.triangles());
  for (int t : reliableTriangles(body.positions(), body.triangles(), neighbours))
    surface.tags.push_back({body.faceOfTriangle()[t], regions[t], 0});
  return surface;
}

/// The feature edges for refinement according to the settings.
class RefinedFeatures {
 public:
  RefinedFeatures(const MeshBody& body, const MeshSettings& settings,
                  std::span<const MeshRegion> regions, const std::vector<RegionBorder>& borders)
      : sharp_(settings.refineAtSharpEdges),
        borders_(settings.refineAtBorders),
        sides_(refinedBorders(regions, borders)),
        faces_(refinedPatches(regions, body)) {}

  bool contains(const SurfaceTag& one, const SurfaceTag& other) const {
    if (sharp_ && one.region != other.region) return true;
    return borders_ && (((one.sides ^ other.sides) & sides_) != 0 ||
                        faces_.contains(one.face) != faces_.contains(other.face));
  }

 private:
  bool sharp_;
  bool borders_;
  std::uint64_t sides_;
  std::set<int> faces_;
};

/// Calls `visit(a, b)` with the ends of every feature edge for refinement.
template <class Visit>
void forRefinedEdges(const TaggedSurface& surface, const RefinedFeatures& refined, Visit visit) {
  const auto neighbours = triangleNeighbours(surface.triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const SurfaceTag& other = surface.tags[neighbours[t][k]];
      if (surface.tags[t] < other && refined.contains(surface.tags[t], other))
        visit(surface.positions[surface.triangles[t][k]],
              surface.positions[surface.triangles[t][(k + 1) % 3]]);
    }
}

/// Settings with an edge length of at most half of the body's diagonal: lengths derived from larger
/// edges would be meaningless.
MeshSettings bounded(MeshSettings settings, const MeshBody& body) {
  const auto [low, high] = boundingBox(Body(body));
  settings.edgeLength = std::min(settings.edgeLength, 0.5 * (high - low).norm());
  return settings;
}

/// Calls `visit(a, b, length)` with the ends and the wanted length of every edge on the border of a
/// stroke that is thin enough to need shorter edges than `edgeLength`.
template <class Visit>
void forThinStrokes(const TaggedSurface& surface, const std::vector<RegionBorder>& borders,
                    double edgeLength, Visit visit) {
  const auto neighbours = triangleNeighbours(surface.triangles);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t sides = surface.tags[t].sides;
      const std::uint64_t between = sides & ~surface.tags[neighbours[t][k]].sides;
      if (between == 0) continue;
      const Vector3d& a = surface.positions[surface.triangles[t][k]];
      const Vector3d& b = surface.positions[surface.triangles[t][(k + 1) % 3]];
      for (std::uint64_t bits = between; bits != 0; bits &= bits - 1) {
        const RegionBorder& border = borders[std::countr_zero(bits)];
        if (const double length = kMeanOfLongest * border.edgeAt(0.5 * (a + b), edgeLength);
            length < edgeLength)
          visit(a, b, length);
      }
    }
}

bool anyPainted(const std::vector<RegionBorder>& borders) {
  return std::any_of(borders.begin(), borders.end(),
                     [](const RegionBorder& border) { return border.isPainted(); });
}

double finestLength(const MeshSettings& settings) {
  return std::ldexp(settings.edgeLength, -settings.refinementLevels);
}

SizeField sizeField(const TaggedSurface& surface, const MeshSettings& settings,
                    const RefinedFeatures& refined, const std::vector<RegionBorder>& borders,
                    std::span<const MeshFocus> foci) {
  SizeField sizes(settings.edgeLength / kMeanEdge);
  forThinStrokes(surface, borders, settings.edgeLength,
                 [&](const Vector3d& a, const Vector3d& b, double length) {
                   sizes.addSource(a, b, length / kMeanEdge);
                 });
  if (settings.refinementLevels > 0)
    forRefinedEdges(surface, refined, [&](const Vector3d& a, const Vector3d& b) {
      sizes.addSource(a, b, finestLength(settings) / kMeanEdge);
    });
  for (const auto& [center, radius, length] : foci)
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d reach = radius / 2 * Vector3d::Unit(axis);
      sizes.addSource(center - reach, center + reach, length / kMeanEdge);
    }
  sizes.update();
  return sizes;
}

TaggedSurface cutSurface(const MeshBody& body, const MeshSettings& settings,
                         const std::vector<RegionBorder>& borders) {
  TaggedSurface surface = taggedSurface(body, settings.edgeLength);
  for (std::size_t k = 0; k < borders.size(); ++k)
    cutAtBorder(surface, borders[k], static_cast<int>(k), kSnap * settings.edgeLength,
                settings.edgeLength);
  return surface;
}

/// Position along the Z-order curve through the box around all nodes (Morton, 1966).
std::uint64_t mortonIndex(const Vector3d& at, const Vector3d& low, double extent) {
  constexpr int kBits = 20;
  std::uint64_t index = 0;
  std::array<std::uint64_t, 3> cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = static_cast<std::uint64_t>((at[axis] - low[axis]) / extent * ((1 << kBits) - 1));
  for (int bit = kBits - 1; bit >= 0; --bit)
    for (int axis = 0; axis < 3; ++axis) index = 2 * index + ((cell[axis] >> bit) & 1);
  return index;
}

/// Sorts the nodes along the curve and the triangles by tag and lowest node.
void renumber(TaggedSurface& surface) {
  Vector3d low = surface.positions.front();
  Vector3d high = low;
  for (const Vector3d& p : surface.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high - low).maxCoeff();
  std::vector<std::pair<std::uint64_t, int>> order;
  for (std::size_t i = 0; i < surface.positions.size(); ++i)
    order.emplace_back(mortonIndex(surface.positions[i], low, extent), static_cast<int>(i));
  std::sort(order.begin(), order.end());
  std::vector<int> number(order.size());
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i].second] = static_cast<int>(i);
    positions.push_back(surface.positions[order[i].second]);
  }
  surface.positions = std::move(positions);
  std::vector<std::pair<SurfaceTag, std::array<int, 3>>> triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<int, 3> n = surface.triangles[t];
    for (int& node : n) node = number[node];
    std::rotate(n.begin(), std::min_element(n.begin(), n.end()), n.end());
    triangles.emplace_back(surface.tags[t], n);
  }
  std::sort(triangles.begin(), triangles.end());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    std::tie(surface.tags[t], surface.triangles[t]) = triangles[t];
}

/// Throws ModelingError if the mesh lost much of the body's volume.
void checkVolume(const TaggedSurface& surface, const MeshBody& body, double edgeLength) {
  double sum = 0.0;
  const Vector3d origin = surface.positions.front();
  for (const auto& [a, b, c] : surface.triangles)
    sum += (surface.positions[a] - origin)
               .dot((surface.positions[b] - origin).cross(surface.positions[c] - origin));
  const double exact = volume(body);
  if (std::abs(sum / 6.0 - exact) > kMaxVolumeChange * exact)
    throw ModelingError("mesh.edge_length_mm: " + numberText(edgeLength) +
                        " mm is too coarse for this body: the mesh would have " +
                        std::to_string(std::lround(100.0 * sum / 6.0 / exact)) +
                        " % of its volume; choose a shorter edge");
}

/// Settings of the mesh whose triangles become quadratic elements.
MeshSettings ofQuadraticCorners(MeshSettings settings) {
  settings.edgeLength *= 2;
  return settings;
}

std::vector<MeshFocus> ofQuadraticCorners(std::span<const MeshFocus> foci) {
  std::vector<MeshFocus> doubled(foci.begin(), foci.end());
  for (MeshFocus& focus : doubled) focus.edgeLength *= 2;
  return doubled;
}

}  // namespace

double estimateNodeCount(const MeshBody& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions, std::span<const MeshFocus> foci) {
  settings.validate();
  for (const MeshRegion& region : regions) checkRegion(region.where, body, region.name);
  const double h = settings.edgeLength;
  const double plain =
      area(body) / (kAreaPerNode * h * h) + 2.0 + focusNodes(foci, h, kAreaPerNode);
  const std::vector<RegionBorder> borders = distinctBorders(regions);
  if (settings.refinementLevels == 0 && !anyPainted(borders)) return plain;
  const RefinedFeatures refined(body, settings, regions, borders);
  // As for solids (refinement_estimate.h): the size grows from a with the distance s as a + g s.
  const auto perLength = [h](double a) {
    constexpr double g = kSizeGrowth;
    return 2.0 * ((1.0 / a - 1.0 / h) / g - (h - a) / (g * h * h)) / kAreaPerNode;
  };
  const TaggedSurface surface = cutSurface(body, settings, borders);
  double more = 0.0;
  double finest = h;
  for (const MeshFocus& focus : foci) finest = std::min(finest, focus.edgeLength);
  forThinStrokes(surface, borders, h, [&](const Vector3d& a, const Vector3d& b, double length) {
    more += (b - a).norm() * perLength(length);
    finest = std::min(finest, length);
  });
  if (settings.refinementLevels > 0) {
    finest = std::min(finest, finestLength(settings));
    forRefinedEdges(surface, refined, [&](const Vector3d& a, const Vector3d& b) {
      more += (b - a).norm() * perLength(finestLength(settings));
    });
  }
  return std::min(plain + more, area(body) / (kAreaPerNode * finest * finest) + 2.0);
}

SurfaceMesh mesh(const MeshBody& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job,
                 std::span<const MeshFocus> foci) {
  job.report(Phase::kMesh, 0.0);
  const double expected = estimateNodeCount(body, settings, regions, foci);
  if (!(expected <= kMaxNodes))
    throw ModelingError("mesh.edge_length_mm: " + numberText(settings.edgeLength) +
                            " mm would need about " + estimateText(expected) + " nodes; at most " +
                            countText(kMaxNodes) + " are possible; choose a longer edge",
                        ModelingError::Kind::kTooLarge);
  const std::vector<RegionBorder> borders = distinctBorders(regions);
  const MeshSettings used = bounded(settings, body);
  const TaggedSurface original = cutSurface(body, used, borders);
  job.throwIfCancelled();
  job.report(Phase::kMesh, 0.1);
  const RefinedFeatures refined(body, used, regions, borders);
  const Job remeshing{job.stop,
                      [&job](Phase phase, double done) { job.report(phase, 0.1 + 0.85 * done); },
                      job.threads};
  TaggedSurface surface =
      remesh(original, sizeField(original, used, refined, borders, foci), remeshing);
  checkVolume(surface, body, settings.edgeLength);
  renumber(surface);
  SurfaceMesh mesh;
  mesh.positions = std::move(surface.positions);
  mesh.triangles = std::move(surface.triangles);
  for (const SurfaceTag& tag : surface.tags) {
    mesh.patchOfTriangle.push_back(tag.face);
    mesh.smoothingGroupOfTriangle.push_back(tag.region);
    mesh.bordersOfTriangle.push_back(tag.sides);
  }
  mesh.borders = borders;
  for (const MeshRegion& region : regions)
    mesh.trianglesOfRegion.push_back(
        trianglesOf(region, body, mesh.patchOfTriangle, mesh.bordersOfTriangle, borders));
  job.report(Phase::kMesh, 1.0);
  return mesh;
}

Engine engineFor(const Body& body, Engine wanted) {
  if (wanted != Engine::kAutomatic) return wanted;
  return std::holds_alternative<Solid>(body) ? Engine::kSplines : Engine::kTriangles;
}

SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job,
                 std::span<const MeshFocus> foci) {
  const auto meshed = [&](const MeshSettings& of, std::span<const MeshFocus> at) {
    return std::visit([&](const auto& one) { return mesh(one, of, regions, job, at); }, body);
  };
  if (engineFor(body, settings.engine) != Engine::kQuadratic) return meshed(settings, foci);
  const SurfaceMesh corners = meshed(ofQuadraticCorners(settings), ofQuadraticCorners(foci));
  std::vector<bool> isSupported(corners.triangles.size(), false);
  for (std::size_t k = 0; k < regions.size(); ++k)
    if (regions[k].isSupport)
      for (const int t : corners.trianglesOfRegion[k]) isSupported[t] = true;
  return quadraticMesh(corners, body, isSupported);
}

double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions, std::span<const MeshFocus> foci) {
  const auto estimated = [&](const MeshSettings& of, std::span<const MeshFocus> at) {
    return std::visit([&](const auto& one) { return estimateNodeCount(one, of, regions, at); },
                      body);
  };
  if (engineFor(body, settings.engine) != Engine::kQuadratic) return estimated(settings, foci);
  // A closed surface has three edges for every node.
  return 4 * estimated(ofQuadraticCorners(settings), ofQuadraticCorners(foci));
}

}  // namespace palpa::modeling

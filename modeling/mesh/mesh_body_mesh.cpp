#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "base/count_text.h"
#include "base/text.h"
#include "modeling/error.h"
#include "modeling/mesh/engine_choice.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_body_surface.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/mesh/quadratic_mesh.h"
#include "modeling/mesh/quarter_crossings.h"
#include "modeling/mesh/surface_remesher.h"
#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Settings with an edge length of at most half of the body's diagonal: lengths derived from larger
/// edges would be meaningless.
MeshSettings bounded(MeshSettings settings, const MeshBody& body) {
  const auto [low, high] = boundingBox(Body(body));
  settings.edgeLength = std::min(settings.edgeLength, 0.5 * (high - low).norm());
  return settings;
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
  settings.engine = Engine::kQuadratic;  // not the choice that led to it
  return settings;
}

std::vector<MeshFocus> ofQuadraticCorners(std::span<const MeshFocus> foci) {
  std::vector<MeshFocus> doubled(foci.begin(), foci.end());
  for (MeshFocus& focus : doubled) focus.edgeLength *= 2;
  return doubled;
}

/// Faces of the triangles of a mesh: those named in a region have their number in the tags, the
/// others are the nearest.
std::vector<int> facesOf(const TaggedSurface& surface, const SimplifiedSurface& simplified) {
  std::set<int> named;
  for (const SurfaceTag& tag : surface.tags) named.insert(tag.face);
  std::vector<std::array<Vector3d, 3>> corners;
  std::vector<int> faces;
  for (std::size_t t = 0; t < simplified.triangles.size(); ++t) {
    if (named.contains(simplified.faceOfTriangle[t])) continue;
    const auto& [a, b, c] = simplified.triangles[t];
    corners.push_back({simplified.positions[a], simplified.positions[b], simplified.positions[c]});
    faces.push_back(simplified.faceOfTriangle[t]);
  }
  const NearestOnTriangles others(corners);
  std::vector<int> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vector3d middle =
        (surface.positions[a] + surface.positions[b] + surface.positions[c]) / 3;
    const int face = surface.tags[t].face;
    result.push_back(face == kOtherFace ? faces[others.nearestTriangle(middle)] : face);
  }
  return result;
}

/// A mesh and its faults.
struct Attempt {
  SurfaceMesh mesh;
  std::size_t crossings = 0;
  bool hasSlivers = false;  ///< triangles too thin for a good solution

  bool isBetterThan(const Attempt& other) const {
    return std::pair(crossings, hasSlivers) < std::pair(other.crossings, other.hasSlivers);
  }
};

/// What is left out, in shares of the feature fraction, by the attempts until a mesh has no
/// crossings. Other features vanish with each; slivers are worth two more attempts only.
constexpr LeftOutFeatures kAttempts[] = {{1, ThinPlaces::kRemoved},   {0.8, ThinPlaces::kRemoved},
                                         {0.5, ThinPlaces::kRemoved}, {1, ThinPlaces::kKept},
                                         {0.2, ThinPlaces::kKept},    {0, ThinPlaces::kKept}};

constexpr std::size_t kMaxFound = 1000;  // crossings

bool hasSlivers(const SurfaceMesh& mesh) {
  constexpr double kMinAngle = 1;  // degrees
  return measureQuality(mesh).smallestAngle < kMinAngle;
}

/// New triangulation, finer where it cuts through itself. Returns also the number of crossings.
std::pair<TaggedSurface, std::size_t> remeshWithoutCrossings(const MeshBodySurface& made,
                                                             const Job& job) {
  constexpr int kRounds = 2;
  const Job quiet{job.stop, {}, job.threads};
  SizeField sizes = made.sizes;
  for (int round = 1;; ++round) {
    TaggedSurface surface = remesh(made.surface, sizes, made.smallest, job);
    const auto crossings =
        triangleCrossings(surface.positions, surface.triangles, kMaxFound, quiet);
    if (crossings.empty() || round == kRounds) return {std::move(surface), crossings.size()};
    for (const TriangleCrossing& crossing : crossings)
      for (const int t : {crossing.a, crossing.b})
        for (int k = 0; k < 3; ++k) {
          const Vector3d& from = surface.positions[surface.triangles[t][k]];
          const Vector3d& to = surface.positions[surface.triangles[t][(k + 1) % 3]];
          sizes.addSource(from, to,
                          std::max(0.5 * (to - from).norm(), made.smallest((from + to) / 2)));
        }
    sizes.update();
  }
}

/// A mesh of the body without the features `leftOut`. Throws ModelingError if it has lost the
/// body's volume or a region.
Attempt tryMesh(const MeshBody& body, const MeshSettings& settings,
                std::span<const MeshRegion> regions, std::span<const MeshFocus> foci,
                const LeftOutFeatures& leftOut, const Job& job) {
  const auto made = meshBodySurface(body, settings, regions, foci, leftOut, job);
  job.throwIfCancelled();
  auto [surface, crossings] = remeshWithoutCrossings(*made, job);
  checkVolume(surface, body, settings.edgeLength);
  renumber(surface);
  Attempt attempt;
  SurfaceMesh& mesh = attempt.mesh;
  mesh.patchOfTriangle = facesOf(surface, made->simplified);
  mesh.positions = std::move(surface.positions);
  mesh.triangles = std::move(surface.triangles);
  for (const SurfaceTag& tag : surface.tags) {
    mesh.smoothingGroupOfTriangle.push_back(tag.region);
    mesh.bordersOfTriangle.push_back(tag.sides);
  }
  mesh.borders = distinctBorders(regions);
  for (const MeshRegion& region : regions)
    mesh.trianglesOfRegion.push_back(
        trianglesOf(region, body, mesh.patchOfTriangle, mesh.bordersOfTriangle, mesh.borders));
  if (made->below > 0)
    mesh.simplification = {
        made->below,      made->simplified.moved,   made->simplified.vanishedFaces,
        made->partsBelow, made->simplified.cutPins, made->simplified.filledHoles};
  attempt.crossings = crossings;
  attempt.hasSlivers = hasSlivers(mesh);
  if (attempt.crossings == 0 && attempt.hasSlivers)
    attempt.crossings = quarterCrossings(mesh, kMaxFound, {job.stop, {}, job.threads});
  return attempt;
}

}  // namespace

double estimateNodeCount(const MeshBody& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions, std::span<const MeshFocus> foci,
                         const Job& job) {
  settings.validate();
  for (const MeshRegion& region : regions) checkRegion(region.where, body, region.name);
  const double finest = std::ldexp(settings.edgeLength, -settings.refinementLevels);
  const double rough = area(body) / (settings.edgeLength * settings.edgeLength);
  // More cannot be counted, only refused.
  if (!(rough <= kMaxNodes) || !(finest > 0)) return rough;
  const MeshSettings used = bounded(settings, body);
  const auto made = meshBodySurface(body, used, regions, foci, {used.featureFraction}, job);
  // Nothing is as good an estimate as the mesh.
  if (const std::size_t known = made->meshedNodes; known > 0) return static_cast<double>(known);
  return expectedNodes(made->surface, made->sizes);
}

SurfaceMesh mesh(const MeshBody& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job,
                 std::span<const MeshFocus> foci) {
  job.report(Phase::kMesh, 0.0);
  const Job quiet{job.stop, {}, job.threads};
  const double expected = estimateNodeCount(body, settings, regions, foci, quiet);
  if (!(expected <= kMaxNodes))
    throw ModelingError("mesh.edge_length_mm: " + numberText(settings.edgeLength) +
                            " mm would need about " + estimateText(expected) + " nodes; at most " +
                            countText(kMaxNodes) + " are possible; choose a longer edge",
                        ModelingError::Kind::kTooLarge);
  const MeshSettings used = bounded(settings, body);
  double done = 0;
  // The progress of later attempts cannot fall.
  const Job remeshing{job.stop,
                      [&](Phase phase, double part) {
                        done = std::max(done, 0.1 + 0.85 * part);
                        job.report(phase, done);
                      },
                      job.threads};
  std::optional<Attempt> best;
  std::exception_ptr fault;
  for (const auto& [share, thin] : kAttempts) {
    const double below = share * used.featureFraction;
    try {
      Attempt attempt = tryMesh(body, used, regions, foci, {below, thin}, remeshing);
      if (!best || attempt.isBetterThan(*best)) best = std::move(attempt);
    } catch (const EmptyRegionError&) {
      throw;
    } catch (const ModelingError& error) {
      if (error.kind() == ModelingError::Kind::kTooLarge) throw;
      if (!fault) fault = std::current_exception();
    }
    const bool mayImprove = share > 0.5 && thin == ThinPlaces::kRemoved;
    if ((best && best->crossings == 0 && !(mayImprove && best->hasSlivers)) || below == 0) break;
  }
  if (!best) std::rethrow_exception(fault);
  meshBodySurface(body, used, regions, foci, {used.featureFraction}, job)->meshedNodes =
      best->mesh.positions.size();
  job.report(Phase::kMesh, 1.0);
  return std::move(best->mesh);
}

SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job,
                 std::span<const MeshFocus> foci) {
  const auto meshed = [&](const MeshSettings& of, std::span<const MeshFocus> at) {
    return std::visit([&](const auto& one) { return mesh(one, of, regions, job, at); }, body);
  };
  if (engineFor(body, settings.engine, regions) != Engine::kQuadratic)
    return meshed(settings, foci);
  SurfaceMesh corners = meshed(ofQuadraticCorners(settings), ofQuadraticCorners(foci));
  std::vector<bool> isSupported(corners.triangles.size(), false);
  for (std::size_t k = 0; k < regions.size(); ++k)
    if (regions[k].isSupport)
      for (const int t : corners.trianglesOfRegion[k]) isSupported[t] = true;
  return quadraticMesh(std::move(corners), body, std::move(isSupported));
}

double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions, std::span<const MeshFocus> foci,
                         const Job& job) {
  const auto estimated = [&](const MeshSettings& of, std::span<const MeshFocus> at) {
    if (const auto* solid = std::get_if<Solid>(&body))
      return estimateNodeCount(*solid, of, regions, at);
    return estimateNodeCount(std::get<MeshBody>(body), of, regions, at, job);
  };
  if (engineFor(body, settings.engine, regions) != Engine::kQuadratic)
    return estimated(settings, foci);
  // A closed surface has three edges for every node.
  return 4 * estimated(ofQuadraticCorners(settings), ofQuadraticCorners(foci));
}

}  // namespace palpa::modeling

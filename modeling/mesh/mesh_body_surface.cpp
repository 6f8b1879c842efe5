#include "modeling/mesh/mesh_body_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>

#include "modeling/body/smooth_regions.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/mesh/surface_cut.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Smooth regions smaller than the square of this fraction of the edge length get no sharp edge.
constexpr double kMinDetail = 1.0 / 8.0;
constexpr double kSnap = 0.05;  // of the edge length: sharp edges nearer to a border belong to it
/// Requested length of remeshed edges, of strokeEdge(): that is the largest length of bisected
/// edges, whose lengths vary more.
constexpr double kMeanOfLongest = 0.85;
constexpr double kPerRadius = std::numbers::pi / 4;  // edge length on curved surfaces: 45 degrees
constexpr double kMinFraction = 1.0 / 32.0;          // of the edge length: the shortest edges
constexpr double kOfSmallest = 0.8;                  // the shortest edges, of the smallest feature
constexpr double kSliver = 0.1;  // of the smallest length: narrower triangles show no curvature

std::set<int> namedFaces(std::span<const MeshRegion> regions, const MeshBody& body) {
  std::set<int> faces;
  for (const MeshRegion& region : regions)
    for (const auto* parts : {&region.where.parts, &region.where.except})
      for (const RegionPart& part : *parts)
        if (const auto* set = std::get_if<PatchSet>(&part))
          for (const std::string& name : set->patches)
            if (const auto face = body.findFace(name)) faces.insert(*face);
  return faces;
}

TaggedSurface taggedSurface(const SimplifiedSurface& simplified, const std::set<int>& named,
                            double edgeLength) {
  const double detail = kMinDetail * edgeLength;
  const std::vector<int> regions =
      smoothRegions(simplified.positions, simplified.triangles, detail * detail,
                    static_cast<int>(simplified.triangles.size()));
  TaggedSurface surface{simplified.positions, simplified.triangles, {}};
  const auto neighbours = triangleNeighbours(simplified.triangles);
  for (int t : reliableTriangles(simplified.positions, simplified.triangles, neighbours)) {
    const int face = simplified.faceOfTriangle[t];
    surface.tags.push_back({named.contains(face) ? face : kOtherFace, regions[t], 0});
  }
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

double finestLength(const MeshSettings& settings) {
  return std::ldexp(settings.edgeLength, -settings.refinementLevels);
}

/// Sizes away from features: the edge length, and less at foci.
SizeField sizesAtFoci(double edgeLength, std::span<const MeshFocus> foci) {
  SizeField sizes(edgeLength / kMeanEdge);
  for (const auto& [center, radius, length] : foci)
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d reach = radius / 2 * Vector3d::Unit(axis);
      sizes.addSource(center - reach, center + reach, length / kMeanEdge);
    }
  sizes.update();
  return sizes;
}

/// `fraction` of the edge length wanted away from curvature: at foci, in and near strokes, and at
/// sharp edges if these are refined.
LengthAt fractionOfLength(const MeshSettings& settings, const std::vector<RegionBorder>& borders,
                          std::span<const MeshFocus> foci, double fraction) {
  const double edgeLength =
      settings.refineAtSharpEdges ? finestLength(settings) : settings.edgeLength;
  return [=, sizes = sizesAtFoci(edgeLength, foci)](const Vector3d& x) {
    double length = kMeanEdge * sizes.at(x);
    for (const RegionBorder& border : borders)
      if (border.isPainted() && border.value(x) < settings.edgeLength)
        length = std::min(length, kMeanOfLongest * border.edgeAt(x, settings.edgeLength));
    return fraction * length;
  };
}

/// `fraction` of the edge length, 0 at foci and in and near strokes: pins and holes farther away
/// matter less to a touch than the sizes of triangles there, which grow slowly with the distance.
LengthAt partSize(const MeshSettings& settings, const std::vector<RegionBorder>& borders,
                  std::span<const MeshFocus> foci, double fraction) {
  constexpr double kReach = 1.25;  // radii of a focus
  return [=, foci = std::vector<MeshFocus>(foci.begin(), foci.end())](const Vector3d& x) {
    const bool isUsed =
        std::any_of(foci.begin(), foci.end(),
                    [&](const MeshFocus& focus) {
                      return (x - focus.center).norm() < kReach * focus.radius;
                    }) ||
        std::any_of(borders.begin(), borders.end(), [&](const RegionBorder& border) {
          return border.isPainted() && border.value(x) < settings.edgeLength;
        });
    return isUsed ? 0 : fraction * settings.edgeLength;
  };
}

/// Calls `visit(a, b, length)` with the ends and the wanted length of every edge on the border of a
/// stroke that is thin enough to need shorter edges than `edgeLength`.
template <class Visit>
void forThinStrokes(const TaggedSurface& surface, const std::vector<std::array<int, 3>>& neighbours,
                    const std::vector<RegionBorder>& borders, double edgeLength, Visit visit) {
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

/// Calls `visit(a, b)` with the ends of every feature edge for refinement.
template <class Visit>
void forRefinedEdges(const TaggedSurface& surface,
                     const std::vector<std::array<int, 3>>& neighbours,
                     const RefinedFeatures& refined, Visit visit) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const SurfaceTag& other = surface.tags[neighbours[t][k]];
      if (surface.tags[t] < other && refined.contains(surface.tags[t], other))
        visit(surface.positions[surface.triangles[t][k]],
              surface.positions[surface.triangles[t][(k + 1) % 3]]);
    }
}

/// Calls `visit(a, b, radius)` with the ends of the edges of curved surfaces (as flat triangles, so
/// that they bend at their edges) and the radius of curvature across the edge.
template <class Visit>
void forBends(const SimplifiedSurface& surface, const LengthAt& smallest, Visit visit) {
  constexpr double kFlat = 1e-8;  // 1 - cosine
  const double sharp = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180);
  const auto& p = surface.positions;
  const auto neighbours = triangleNeighbours(surface.triangles);
  const auto areaVector = [&](int t) {
    const auto& [a, b, c] = surface.triangles[t];
    return Vector3d((p[b] - p[a]).cross(p[c] - p[a]));
  };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int other = neighbours[t][k];
      if (other < static_cast<int>(t)) continue;
      const Vector3d one = areaVector(static_cast<int>(t)), two = areaVector(other);
      const double cosine = one.normalized().dot(two.normalized());
      if (!(cosine > sharp && cosine < 1 - kFlat)) continue;
      const Vector3d& a = p[surface.triangles[t][k]];
      const Vector3d& b = p[surface.triangles[t][(k + 1) % 3]];
      const double width = (one.norm() + two.norm()) / (2 * (b - a).norm());
      if (width > kSliver * smallest(0.5 * (a + b))) visit(a, b, width / std::acos(cosine));
    }
}

SizeField sizeField(const MeshBodySurface& made, const SimplifiedSurface& bent,
                    const MeshSettings& settings, const RefinedFeatures& refined,
                    const std::vector<RegionBorder>& borders, std::span<const MeshFocus> foci) {
  SizeField sizes = sizesAtFoci(settings.edgeLength, foci);
  const auto neighbours = triangleNeighbours(made.surface.triangles);
  forThinStrokes(made.surface, neighbours, borders, settings.edgeLength,
                 [&](const Vector3d& a, const Vector3d& b, double length) {
                   sizes.addSource(a, b, length / kMeanEdge);
                 });
  if (settings.refinementLevels > 0)
    forRefinedEdges(made.surface, neighbours, refined, [&](const Vector3d& a, const Vector3d& b) {
      sizes.addSource(a, b, finestLength(settings) / kMeanEdge);
    });
  forBends(bent, made.smallest, [&](const Vector3d& a, const Vector3d& b, double radius) {
    const double smallest = made.smallest(0.5 * (a + b)) / kOfSmallest;
    if (radius < smallest) return;  // a feature that should have gone
    sizes.addSource(a, b, std::max(smallest, kPerRadius * radius) / kMeanEdge);
  });
  sizes.update();
  return sizes;
}

std::shared_ptr<const MeshBodySurface> make(const MeshBody& body, const MeshSettings& settings,
                                            std::span<const MeshRegion> regions,
                                            std::span<const MeshFocus> foci,
                                            const LeftOutFeatures& leftOut, const Job& job) {
  const std::vector<RegionBorder> borders = distinctBorders(regions);
  const std::set<int> named = namedFaces(regions, body);
  const auto made = std::make_shared<MeshBodySurface>(settings.edgeLength);
  made->smallest = fractionOfLength(settings, borders, foci,
                                    std::max(kOfSmallest * settings.featureFraction, kMinFraction));
  const LengthAt feature = fractionOfLength(settings, borders, foci, leftOut.below);
  // Smaller features that stay after all are no reason to keep pins and holes.
  const double ofParts = leftOut.below > 0 ? settings.featureFraction : 0;
  SimplifiedSurface bent = withoutSmallFeatures(
      body, feature, partSize(settings, borders, foci, ofParts), named, leftOut.thin, job);
  if (bent.isNeeded) {
    made->simplified = bent;
    made->below = leftOut.below * settings.edgeLength;
    made->partsBelow = ofParts * settings.edgeLength;
  } else {
    made->simplified = {{body.positions(), body.triangles(), body.faceOfTriangle()}};
  }
  made->surface = taggedSurface(made->simplified, named, settings.edgeLength);
  for (std::size_t k = 0; k < borders.size(); ++k)
    cutAtBorder(made->surface, borders[k], static_cast<int>(k), kSnap * settings.edgeLength,
                settings.edgeLength);
  job.throwIfCancelled();
  made->sizes = sizeField(*made, bent, settings, RefinedFeatures(body, settings, regions, borders),
                          borders, foci);
  return made;
}

/// Arguments of make() with its result.
struct Known {
  MeshBody body;
  MeshSettings settings;
  std::vector<Region> regions;
  std::vector<bool> isSupport;
  std::vector<MeshFocus> foci;
  LeftOutFeatures leftOut;
  std::shared_ptr<const MeshBodySurface> made;

  bool isFor(const Known& other) const {
    return &body.positions() == &other.body.positions() && settings == other.settings &&
           regions == other.regions && isSupport == other.isSupport && foci == other.foci &&
           leftOut == other.leftOut;
  }
};

}  // namespace

std::shared_ptr<const MeshBodySurface> meshBodySurface(
    const MeshBody& body, const MeshSettings& settings, std::span<const MeshRegion> regions,
    std::span<const MeshFocus> foci, const LeftOutFeatures& leftOut, const Job& job) {
  constexpr std::size_t kMaxKnown = 2;
  static std::mutex mutex;
  static std::list<Known> known;
  Known wanted{body, settings, {}, {}, {foci.begin(), foci.end()}, leftOut, {}};
  for (const MeshRegion& region : regions) {
    wanted.regions.push_back(region.where);
    wanted.isSupport.push_back(region.isSupport);
  }
  {
    const std::lock_guard lock(mutex);
    for (const Known& one : known)
      if (one.isFor(wanted)) return one.made;
  }
  wanted.made = make(body, settings, regions, foci, leftOut, job);
  const std::lock_guard lock(mutex);
  known.push_front(wanted);
  if (known.size() > kMaxKnown) known.pop_back();
  return wanted.made;
}

}  // namespace palpa::modeling

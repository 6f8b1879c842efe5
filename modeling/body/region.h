#pragma once

#include <Eigen/Core>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "modeling/body/body.h"

namespace palpa::modeling {

/// All points of the named patches.
struct PatchSet {
  std::vector<std::string> patches;
};

/// All surface points x (mm) with normal · x < below. With a unit normal, `below` is a distance
/// from the origin in mm; the normal is used as given, not normalised.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double below = 0.0;

  bool operator==(const HalfSpace& other) const {
    return normal == other.normal && below == other.below;
  }

  double value(const Eigen::Vector3d& x) const { return normal.dot(x) - below; }
};

/// What one stroke of a brush paints: all surface points nearer than `radius` (mm) to the polyline
/// through `points` (mm, in space); one point paints with a ball. Distances are straight, so a thin
/// wall is painted on both sides when the radius reaches through it.
struct Stroke {
  static constexpr std::size_t kMaxPoints = 10'000;

  std::vector<Eigen::Vector3d> points;
  double radius = 1.0;

  bool operator==(const Stroke& other) const {
    return points == other.points && radius == other.radius;
  }

  /// Point of the polyline nearest to x. Linear in the number of points, of which there must be
  /// one.
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;

  /// Distance from the polyline less the radius in mm: negative inside.
  double value(const Eigen::Vector3d& x) const;
};

using RegionPart = std::variant<PatchSet, HalfSpace, Stroke>;

/// Part of a solid's surface: the union of its parts.
struct Region {
  std::vector<RegionPart> parts;

  static Region ofPatches(std::vector<std::string> names) { return {{PatchSet{std::move(names)}}}; }
  static Region below(const Eigen::Vector3d& normal, double distance) {
    return {{HalfSpace{normal, distance}}};
  }
};

/// Checks a region against a body: at least one part, patch names that exist (the message lists
/// those that do), normals finite and not zero, strokes of 1 … kMaxPoints finite points and a
/// radius above zero. `path` begins the message ("supports[0].where").
/// @throws ModelingError
void checkRegion(const Region& region, const Body& body, const std::string& path);

/// The same for many regions of one body; `names` holds patchNames(body). Thousands of names in a
/// file then cost no more than reading them.
void checkRegion(const Region& region, const Body& body, const std::set<std::string>& names,
                 const std::string& path);

/// How far each position (mm) lies inside (negative) or outside the region, for drawing borders as
/// the zero line of linear interpolation: distances in mm from half spaces and strokes, the least
/// over the parts, between -kRegionFieldCap and kRegionFieldCap times the diagonal of the body's
/// box. Named patches have no distance: their points get the lower cap, so that the line of zeros
/// runs along the patch edge when every patch has vertices of its own. `patchOfPosition` has an
/// index into patchNames(body) for each position. Unknown names are ignored.
std::vector<double> regionField(const Region& region, const Body& body,
                                std::span<const Eigen::Vector3d> positions,
                                std::span<const int> patchOfPosition);

inline constexpr double kRegionFieldCap = 2.0;

}  // namespace palpa::modeling

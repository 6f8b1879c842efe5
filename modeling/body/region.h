#pragma once

#include <Eigen/Core>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "modeling/body/body.h"

namespace palpa::modeling {

/// Surface points of the named patches.
struct PatchSet {
  std::vector<std::string> patches;

  bool operator==(const PatchSet&) const = default;
};

/// Surface points x (mm) with normal · x < below. With a unit normal, `below` is a distance from
/// the origin in mm; the normal is used as given, not normalised.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double below = 0.0;

  bool operator==(const HalfSpace&) const = default;

  /// normal · x - below: negative inside.
  double value(const Eigen::Vector3d& x) const { return normal.dot(x) - below; }
};

/// Region painted by one stroke of a brush: surface points closer than `radius` (mm) to the
/// polyline through `points` (mm, in space); a single point paints with a ball. Distances are
/// straight, so a thin wall is painted on both sides if the radius extends through it.
struct Stroke {
  static constexpr std::size_t kMaxPoints = 10'000;

  std::vector<Eigen::Vector3d> points;
  double radius = 1.0;

  bool operator==(const Stroke&) const = default;

  /// Point of the polyline nearest to x, mm. Cost linear in the number of points; needs at least
  /// one.
  Eigen::Vector3d nearest(const Eigen::Vector3d& x) const;

  /// Distance from the polyline minus the radius, mm: negative inside.
  double value(const Eigen::Vector3d& x) const;
};

using RegionPart = std::variant<PatchSet, HalfSpace, Stroke>;

/// Region of a body's surface: the union of its parts, without the exceptions.
struct Region {
  std::vector<RegionPart> parts;
  std::vector<RegionPart> except{};

  static Region ofPatches(std::vector<std::string> names) { return {{PatchSet{std::move(names)}}}; }
  static Region below(const Eigen::Vector3d& normal, double distance) {
    return {{HalfSpace{normal, distance}}};
  }

  bool operator==(const Region&) const = default;
};

/// True for each patch that one of the parts names, by index into patchNames(body). Unknown names
/// are ignored.
std::vector<bool> namedPatches(const std::vector<RegionPart>& parts, const Body& body);

/// True if the point (mm) lies in one of the half spaces or strokes.
bool isInSpace(const std::vector<RegionPart>& parts, const Eigen::Vector3d& x);

/// Checks a region against a body. Throws ModelingError if the region has no part, if a patch name
/// does not exist (the message lists the existing names), if a normal is not finite or zero, or if
/// a stroke does not have 1 … kMaxPoints finite points and a positive radius; the same for its
/// exceptions. `path` is the beginning of the message ("supports[0].where").
void checkRegion(const Region& region, const Body& body, const std::string& path);

/// Checks a region with precomputed names, for many regions of one body; `names` contains
/// patchNames(body). Thousands of names in a file then cost no more than reading them.
void checkRegion(const Region& region, const Body& body, const std::set<std::string>& names,
                 const std::string& path);

/// Signed distances (mm) of positions (mm) from the region, negative inside, for drawing borders as
/// the zero line of linear interpolation. They are the minimum over the parts of the distances from
/// half spaces and strokes, limited to ±kRegionFieldCap times the diagonal of the body's box. Named
/// patches have no distance: their points get the lower limit, so the zero line follows the patch
/// edge if every patch has separate vertices. The maximum with the negative distances from the
/// exceptions removes these. `patchOfPosition` is an index into patchNames(body)
/// for each position. Unknown names are ignored. Throws std::invalid_argument if the numbers of
/// positions and patches differ.
std::vector<double> regionField(const Region& region, const Body& body,
                                std::span<const Eigen::Vector3d> positions,
                                std::span<const int> patchOfPosition);

inline constexpr double kRegionFieldCap = 2.0;

}  // namespace palpa::modeling

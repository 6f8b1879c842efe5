#pragma once

#include <Eigen/Core>
#include <set>
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

using RegionPart = std::variant<PatchSet, HalfSpace>;

/// Part of a solid's surface: the union of its parts.
struct Region {
  std::vector<RegionPart> parts;

  static Region ofPatches(std::vector<std::string> names) { return {{PatchSet{std::move(names)}}}; }
  static Region below(const Eigen::Vector3d& normal, double distance) {
    return {{HalfSpace{normal, distance}}};
  }
};

/// Checks a region against a body: at least one part, patch names that exist (the message lists
/// those that do), normals finite and not zero. `path` begins the message ("supports[0].where").
/// @throws ModelingError
void checkRegion(const Region& region, const Body& body, const std::string& path);

/// The same for many regions of one body; `names` holds patchNames(body). Thousands of names in a
/// file then cost no more than reading them.
void checkRegion(const Region& region, const Body& body, const std::set<std::string>& names,
                 const std::string& path);

}  // namespace palpa::modeling

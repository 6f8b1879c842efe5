#pragma once

#include <optional>
#include <set>
#include <string>

namespace palpa::gui {

/// Selected control points, patches or edges of the body, or one named item of the project. Only
/// one of the members is not empty.
struct Selection {
  enum class Kind { kSupport, kLoad, kTouch, kMeasurement };
  struct Named {
    Kind kind = Kind::kSupport;
    std::string name;
    bool operator==(const Named&) const = default;
  };

  std::set<int> points;   ///< indices of Solid::controlPoints()
  std::set<int> patches;  ///< indices of patchNames(body)
  std::set<int> edges;    ///< indices of Solid::edges()
  std::optional<Named> named;

  static Selection ofPoints(std::set<int> points) { return {std::move(points), {}, {}, {}}; }
  static Selection ofPatches(std::set<int> patches) { return {{}, std::move(patches), {}, {}}; }
  static Selection ofEdges(std::set<int> edges) { return {{}, {}, std::move(edges), {}}; }
  static Selection of(Kind kind, std::string name) { return {{}, {}, {}, Named{kind, name}}; }

  bool empty() const { return points.empty() && patches.empty() && edges.empty() && !named; }
  bool operator==(const Selection&) const = default;
};

}  // namespace palpa::gui

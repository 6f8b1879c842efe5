#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <vector>

#include "app/gui/view/scene_controller.h"
#include "modeling/solid/solid.h"

namespace palpa::gui {

/// Target of the snapping of a dragged place.
struct SnapTarget {
  enum class Kind { kPoint, kEdge };
  Kind kind = Kind::kPoint;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< mm
};

/// Control points and edges that stand still during a motion, as they were when it began.
class SnapPlaces {
 public:
  SnapPlaces() = default;
  /// `moved`: points that move.
  SnapPlaces(const modeling::Solid& solid, const std::set<int>& moved,
             const SceneController& scene);

  /// The control point or, without one, the place on an edge that the pointer is on.
  std::optional<SnapTarget> near(const Eigen::Vector2d& pixel, const ViewportWidget& widget) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::vector<Eigen::Vector3d>> edges_;
};

}  // namespace palpa::gui

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/gui/view/scene_controller.h"
#include "modeling/measure/measured_body.h"

namespace palpa::gui {

/// Kinds of places that a measurement takes.
enum class MeasureWish {
  kPoint,        ///< snaps to corners and to edges
  kEdge,         ///< the nearest one
  kEdgeOrFace,   ///< an edge under the pointer, else the face
  kEdgeOrPoint,  ///< an edge under the pointer, else the surface point
};

/// Place that a click measures.
struct MeasureTarget {
  enum class Snap { kNone, kCorner, kEdge };
  modeling::MeasuredPlace place;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< mm
  Snap snap = Snap::kNone;
  std::vector<Eigen::Vector3d> line;  ///< along the edge, if it is one
  int patch = -1;                     ///< that the pointer is on
};

/// The place under a pixel, or, a little beside the body, the nearest one. Nothing elsewhere.
/// Throws ModelingError if the body cannot be evaluated.
std::optional<MeasureTarget> measureTargetAt(const Eigen::Vector2d& pixel, MeasureWish wish,
                                             const SceneController& scene,
                                             const ViewportWidget& widget,
                                             const modeling::MeasuredBody& body);

}  // namespace palpa::gui

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/view/camera/turntable.h"

/// The view cube: where its parts lie in the picture, which one is under a pixel, and how the
/// camera turns. Pure arithmetic, no VTK.
namespace palpa::view {

/// A face, an edge or a corner of the cube, or an arrow beside it.
struct ViewCubePart {
  /// Arrows show the side of the body that lies in their direction: a quarter turn.
  enum class Arrow { kNone, kLeft, kRight, kUp, kDown };

  Eigen::Vector3i towards = Eigen::Vector3i::Zero();  ///< outwards, -1, 0, 1; zero: an arrow
  Arrow arrow = Arrow::kNone;

  bool operator==(const ViewCubePart&) const = default;
};

/// Side of the square in the upper right corner that the cube needs, logical pixels.
inline constexpr double kViewCubeSide = 122;

/// A visible part as drawn: a convex polygon, in pixels from the top left corner.
struct ViewCubePolygon {
  ViewCubePart part;
  std::vector<Eigen::Vector2d> corners;
  double facing = 1;  ///< cosine of the angle between its normal and the line of sight; 1: arrow
};

/// All visible parts; they do not overlap.
std::vector<ViewCubePolygon> viewCubePolygons(const Turntable& camera, double pixelRatio);

/// The part under a pixel.
std::optional<ViewCubePart> viewCubePartAt(const Eigen::Vector2d& pixel, const Turntable& camera,
                                           double pixelRatio);

/// Where the words of a face lie, in pixels: the middle of the face, and the vectors along and
/// across the line of words from the middle to the ends of the face.
struct ViewCubeLabel {
  Eigen::Vector2d middle, along, up;
};
ViewCubeLabel viewCubeLabel(const Eigen::Vector3i& face, const Turntable& camera,
                            double pixelRatio);

/// Turns the camera so that it looks at the part, or by a quarter turn for an arrow; focus and
/// distance stay.
void turnTo(const ViewCubePart& part, Turntable& camera);

}  // namespace palpa::view

#include "app/view/camera/view_cube.h"

#include <Eigen/Geometry>
#include <array>
#include <numbers>

namespace palpa::view {
namespace {

using Arrow = ViewCubePart::Arrow;

// In logical pixels.
constexpr double kHalf = 32;       // of the side of the cube
constexpr double kArrowFrom = 49;  // from the middle of the cube to the base of an arrow
constexpr double kArrowLength = 8;
constexpr double kArrowWidth = 8;  // half
constexpr double kFromEdge = 4;

/// Half the side of a face; the rest, to 1, belongs to edges and corners.
constexpr double kFace = 0.74;
/// Parts turned farther away from the eye are not drawn.
constexpr double kMinFacing = 0.02;

struct Solid {
  Eigen::Vector3i towards;
  std::vector<Eigen::Vector3d> corners;  // in order around the part
};

/// The corners of the part on the faces that it touches: (±1 on one axis, ±kFace on the others).
std::vector<Solid> makeSolids() {
  std::vector<Solid> solids;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Eigen::Vector3i towards(x, y, z);
        const int count = towards.cwiseAbs().sum();
        if (count == 0) continue;
        Solid solid{towards, {}};
        std::vector<int> free, fixed;
        for (int k = 0; k < 3; ++k) (towards[k] == 0 ? free : fixed).push_back(k);
        const auto corner = [&](int on, double a, double b) {
          Eigen::Vector3d point = kFace * towards.cast<double>();
          point[on] = towards[on];
          if (!free.empty()) point[free[0]] = a;
          if (free.size() > 1) point[free[1]] = b;
          return point;
        };
        if (count == 1) {
          for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            solid.corners.push_back(corner(fixed[0], a * kFace, b * kFace));
        } else if (count == 2) {
          solid.corners = {corner(fixed[0], -kFace, 0), corner(fixed[0], kFace, 0),
                           corner(fixed[1], kFace, 0), corner(fixed[1], -kFace, 0)};
        } else {
          for (const int on : fixed) solid.corners.push_back(corner(on, 0, 0));
        }
        solids.push_back(std::move(solid));
      }
    }
  }
  return solids;
}

Eigen::Vector2d middleOf(const Turntable& camera, double pixelRatio) {
  const double half = 0.5 * kViewCubeSide + kFromEdge;
  return {camera.width() - half * pixelRatio, half * pixelRatio};
}

/// Parallel to the camera's own picture, but without perspective: the same everywhere.
Eigen::Vector2d toPixel(const Eigen::Vector3d& vector, const ViewAxes& axes, double pixelRatio) {
  return kHalf * pixelRatio * Eigen::Vector2d(vector.dot(axes.right), -vector.dot(axes.up));
}

std::array<ViewCubePolygon, 4> arrows(const Eigen::Vector2d& middle, double pixelRatio) {
  std::array<ViewCubePolygon, 4> all;
  const std::array<std::pair<Arrow, Eigen::Vector2d>, 4> directions{{{Arrow::kLeft, {-1, 0}},
                                                                     {Arrow::kRight, {1, 0}},
                                                                     {Arrow::kUp, {0, -1}},
                                                                     {Arrow::kDown, {0, 1}}}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [arrow, ahead] = directions[i];
    const Eigen::Vector2d across(-ahead.y(), ahead.x());
    const Eigen::Vector2d base = middle + kArrowFrom * pixelRatio * ahead;
    const Eigen::Vector2d side = kArrowWidth * pixelRatio * across;
    all[i].part.arrow = arrow;
    all[i].corners = {base + side, base + kArrowLength * pixelRatio * ahead, base - side};
  }
  return all;
}

bool isInside(const Eigen::Vector2d& pixel, const std::vector<Eigen::Vector2d>& corners,
              double reach) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  const double sign = area < 0 ? -1 : 1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d along = corners[(i + 1) % corners.size()] - a;
    const Eigen::Vector2d from = pixel - a;
    if (sign * (along.x() * from.y() - along.y() * from.x()) < -reach * along.norm()) return false;
  }
  return true;
}

}  // namespace

std::vector<ViewCubePolygon> viewCubePolygons(const Turntable& camera, double pixelRatio) {
  static const std::vector<Solid> solids = makeSolids();
  const ViewAxes axes = camera.axes();
  const Eigen::Vector2d middle = middleOf(camera, pixelRatio);
  std::vector<ViewCubePolygon> polygons;
  for (const Solid& solid : solids) {
    const double facing = -axes.forward.dot(solid.towards.cast<double>().normalized());
    if (facing < kMinFacing) continue;
    ViewCubePolygon& polygon = polygons.emplace_back();
    polygon.part.towards = solid.towards;
    polygon.facing = facing;
    for (const Eigen::Vector3d& corner : solid.corners)
      polygon.corners.push_back(middle + toPixel(corner, axes, pixelRatio));
  }
  for (ViewCubePolygon& arrow : arrows(middle, pixelRatio)) polygons.push_back(std::move(arrow));
  return polygons;
}

std::optional<ViewCubePart> viewCubePartAt(const Eigen::Vector2d& pixel, const Turntable& camera,
                                           double pixelRatio) {
  constexpr double kArrowReach = 4;  // logical pixels around an arrow
  const std::vector<ViewCubePolygon> polygons = viewCubePolygons(camera, pixelRatio);
  for (const ViewCubePolygon& polygon : polygons)
    if (isInside(pixel, polygon.corners, 0)) return polygon.part;
  for (const ViewCubePolygon& polygon : polygons) {
    const bool isArrow = polygon.part.arrow != Arrow::kNone;
    if (isArrow && isInside(pixel, polygon.corners, kArrowReach * pixelRatio)) return polygon.part;
  }
  return std::nullopt;
}

ViewCubeLabel viewCubeLabel(const Eigen::Vector3i& face, const Turntable& camera,
                            double pixelRatio) {
  const ViewAxes axes = camera.axes();
  const Eigen::Vector3d out = face.cast<double>();
  // As in the standard views: upright at the sides, y upwards seen from above, downwards from
  // below.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (face.z() != 0) up = face.z() * Eigen::Vector3d::UnitY();
  return {middleOf(camera, pixelRatio) + toPixel(out, axes, pixelRatio),
          kFace * toPixel(up.cross(out), axes, pixelRatio), kFace * toPixel(up, axes, pixelRatio)};
}

void turnTo(const ViewCubePart& part, Turntable& camera) {
  constexpr double kQuarter = std::numbers::pi / 2;
  switch (part.arrow) {
    case Arrow::kNone: {
      const Eigen::Vector3d direction = -part.towards.cast<double>();
      camera.setDirection(direction, part.towards.z() * Eigen::Vector3d::UnitY());
      return;
    }
    case Arrow::kLeft:
      return camera.turn(-kQuarter, 0);
    case Arrow::kRight:
      return camera.turn(kQuarter, 0);
    case Arrow::kUp:
      return camera.turn(0, -kQuarter);
    case Arrow::kDown:
      return camera.turn(0, kQuarter);
  }
}

}  // namespace palpa::view

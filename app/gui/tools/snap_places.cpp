#include "app/gui/tools/snap_places.h"

#include <algorithm>

#include "app/gui/document/point_groups.h"

namespace palpa::gui {
namespace {

// Logical pixels from the pointer.
constexpr double kPointReach = 11;
constexpr double kEdgeReach = 7;
/// A hidden point counts as this much farther from the pointer, in parts of the reach: visible ones
/// come first, as for clicks.
constexpr double kHiddenPenalty = 0.5;

bool isHidden(const Eigen::Vector3d& place, const view::Viewport& viewport) {
  constexpr double kOnSurface = 1e-3;  // mm per mm of the grid: a point on the surface is visible
  const auto hit = viewport.surfaceAt(viewport.toPixel(place));
  if (!hit) return false;
  const double behind = viewport.camera().direction.dot(place - hit->position);
  return behind > kOnSurface * viewport.gridSpacing();
}

}  // namespace

SnapPlaces::SnapPlaces(const modeling::Solid& solid, const std::set<int>& moved,
                       const SceneController& scene) {
  const auto& points = solid.controlPoints();
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (!moved.contains(i)) points_.push_back(points[static_cast<std::size_t>(i)]);
  for (int edge = 0; edge < static_cast<int>(solid.edges().size()); ++edge) {
    const std::set<int> own = pointsOfEdge(solid, edge);
    if (std::ranges::none_of(own, [&](int point) { return moved.contains(point); }))
      edges_.push_back(scene.edgeLine(edge));
  }
}

std::optional<SnapTarget> SnapPlaces::near(const Eigen::Vector2d& pixel,
                                           const ViewportWidget& widget) const {
  const view::Viewport& viewport = widget.viewport();
  std::optional<SnapTarget> found;
  const double ratio = widget.devicePixelRatioF();
  double least = kPointReach * ratio;
  for (const Eigen::Vector3d& point : points_) {
    double distance = (viewport.toPixel(point) - pixel).norm();
    if (!(distance < least)) continue;  // also a point behind the eye: NaN
    if (isHidden(point, viewport)) distance += kHiddenPenalty * kPointReach * ratio;
    if (distance >= least) continue;
    least = distance;
    found = {SnapTarget::Kind::kPoint, point};
  }
  if (found) return found;
  least = kEdgeReach * ratio;
  for (const std::vector<Eigen::Vector3d>& line : edges_) {
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Eigen::Vector2d from = viewport.toPixel(line[k - 1]);
      const Eigen::Vector2d along = viewport.toPixel(line[k]) - from;
      const double length = along.squaredNorm();
      const double share =
          length > 0 ? std::clamp((pixel - from).dot(along) / length, 0.0, 1.0) : 0.0;
      const double distance = (from + share * along - pixel).norm();
      const Eigen::Vector3d place = line[k - 1] + share * (line[k] - line[k - 1]);
      if (!(distance < least) || isHidden(place, viewport)) continue;
      least = distance;
      found = {SnapTarget::Kind::kEdge, place};
    }
  }
  return found;
}

}  // namespace palpa::gui

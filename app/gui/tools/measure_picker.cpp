#include "app/gui/tools/measure_picker.h"

#include <cmath>
#include <numbers>

namespace palpa::gui {
namespace {

// Logical pixels.
constexpr double kCornerReach = 11;
constexpr double kEdgeReach = 7;
constexpr double kBeside = 6;  // beside the body

using What = modeling::MeasuredPlace::What;

std::optional<SurfacePlace> surfaceNear(const Eigen::Vector2d& pixel, const SceneController& scene,
                                        double ratio) {
  if (const auto place = scene.placeAt(pixel)) return place;
  constexpr int kDirections = 8;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * std::numbers::pi * k / kDirections;
    if (const auto place = scene.placeAt(
            pixel + kBeside * ratio * Eigen::Vector2d(std::cos(angle), std::sin(angle))))
      return place;
  }
  return std::nullopt;
}

}  // namespace

std::optional<MeasureTarget> measureTargetAt(const Eigen::Vector2d& pixel, MeasureWish wish,
                                             const SceneController& scene,
                                             const ViewportWidget& widget,
                                             const modeling::MeasuredBody& body) {
  const double ratio = widget.devicePixelRatioF();
  const auto surface = surfaceNear(pixel, scene, ratio);
  if (!surface) return std::nullopt;
  MeasureTarget target;
  target.patch = surface->patch;
  const auto edge = body.edgeNear(surface->patch, surface->position);
  const auto pixelsTo = [&](const Eigen::Vector3d& place) {
    const double distance = (widget.viewport().toPixel(place) - pixel).norm();
    return std::isnan(distance) ? 1e9 : distance / ratio;
  };
  if (edge) {
    target.line = body.edgeLine(*edge);
    if (wish == MeasureWish::kPoint) {
      for (const Eigen::Vector3d& end : {target.line.front(), target.line.back()}) {
        const bool isClosed = target.line.front() == target.line.back();
        if (isClosed || pixelsTo(end) > kCornerReach) continue;
        target.place = body.placeNear(surface->patch, end);
        target.at = end;
        target.snap = MeasureTarget::Snap::kCorner;
        return target;
      }
    }
    target.at = body.position(*edge);
    if (wish == MeasureWish::kEdge || pixelsTo(target.at) <= kEdgeReach) {
      target.snap = MeasureTarget::Snap::kEdge;
      target.place = *edge;
      if (wish == MeasureWish::kPoint) target.place = body.placeNear(surface->patch, target.at);
      return target;
    }
  }
  if (wish == MeasureWish::kEdge) return std::nullopt;
  target.line.clear();
  target.place = body.placeNear(surface->patch, surface->position);
  if (wish == MeasureWish::kEdgeOrFace) target.place.what = What::kFace;
  target.at = body.position(target.place);
  return target;
}

}  // namespace palpa::gui

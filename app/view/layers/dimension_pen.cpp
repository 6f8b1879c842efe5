#include "app/view/layers/dimension_pen.h"

namespace palpa::view {
namespace {

using Eigen::Vector2d;

constexpr double kHalo = 2;  // logical pixels, on each side of a stroke
constexpr double kHaloOpacity = 0.75;

}  // namespace

void DimensionPen::line(const Vector2d& a, const Vector2d& b, double width) {
  if (!a.allFinite() || !b.allFinite()) return;
  shapes_.addLine(a, b, (width + 2 * kHalo) * unit_, halo_, kHaloOpacity);
  lines_.push_back({a, b, width});
}

void DimensionPen::arrow(const Vector2d& tip, const Vector2d& way) {
  if (!tip.allFinite() || !(way.norm() > 0)) return;
  const Vector2d ahead = way.normalized(), side(-ahead.y(), ahead.x());
  const auto corners = [&](double grow) {
    const Vector2d back = tip - (kArrow * unit_ + grow) * ahead;
    const Vector2d half = (kHalfArrow * unit_ + grow) * side;
    return std::vector<Vector2d>{tip + grow * ahead, back + half, back - half};
  };
  shapes_.addPolygon(corners(kHalo * unit_), halo_, kHaloOpacity);
  heads_.push_back(corners(0));
}

void DimensionPen::dot(const Vector2d& at) {
  if (!at.allFinite()) return;
  shapes_.addDisc(at, (kDot + kHalo) * unit_, halo_, kHaloOpacity);
  dots_.push_back(at);
}

void DimensionPen::finish() {
  for (const Stroke& line : lines_) shapes_.addLine(line.a, line.b, line.width * unit_, colour_);
  for (const auto& head : heads_) shapes_.addPolygon(head, colour_);
  for (const Vector2d& at : dots_) shapes_.addDisc(at, kDot * unit_, colour_);
}

}  // namespace palpa::view

#include "app/view/layers/sample_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpa::view {
namespace {

using Kind = SampleLabel::Kind;

// In logical pixels.
constexpr double kFontSize = 12.5;
constexpr double kDotRadius = 4;
constexpr double kTriangle = 8;
constexpr double kLine = 1.4;
constexpr double kFromEdge = 6;
constexpr double kHiddenOpacity = 0.4;
/// Distances of plates from their points that are tried.
constexpr std::array kDistances{16.0, 42.0, 84.0, 140.0};
constexpr int kDirections = 12;

double clampedOverlap(const PixelBox& box, const std::vector<PixelBox>& taken) {
  double sum = 0;
  for (const PixelBox& other : taken) sum += box.overlap(other);
  return sum;
}

}  // namespace

void SampleLayer::set(const std::vector<SampleLabel>& labels, const ViewportTheme& theme,
                      double pixelRatio) {
  labels_ = labels;
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  std::vector<std::string> texts;
  for (const SampleLabel& label : labels) texts.push_back(label.text);
  texts_.set(texts, {kFontSize * pixelRatio, false, theme.text});
}

Colour SampleLayer::colourOf(Kind kind) const {
  switch (kind) {
    case Kind::kMinimum:
      return kAxisColours[2];
    case Kind::kMaximum:
      return kAppliedForceColour;
    case Kind::kSelected:
      return theme_.handleSelected;
    case Kind::kPointer:
      return theme_.handleHovered;
    case Kind::kPinned:
      break;
  }
  return theme_.touch;
}

void SampleLayer::drawPoint(const Eigen::Vector2d& pixel, Kind kind, double opacity,
                            FlatShapes& shapes) const {
  const Colour colour = colourOf(kind);
  if (kind == Kind::kMinimum || kind == Kind::kMaximum) {
    // A triangle whose tip is at the point: from above for a maximum, from below for a minimum.
    const double size = kTriangle * pixelRatio_;
    const double side = kind == Kind::kMaximum ? -1 : 1;
    const auto corners = [&](double grow) {
      return std::vector<Eigen::Vector2d>{
          pixel + Eigen::Vector2d(0, -side * grow),
          pixel + Eigen::Vector2d(0.62 * size + grow, side * (1.15 * size + grow)),
          pixel + Eigen::Vector2d(-0.62 * size - grow, side * (1.15 * size + grow))};
    };
    shapes.addPolygon(corners(1.6 * pixelRatio_), {1, 1, 1}, 0.9 * opacity);
    shapes.addPolygon(corners(0), colour, opacity);
    return;
  }
  shapes.addDisc(pixel, (kDotRadius + 1.4) * pixelRatio_, {1, 1, 1}, 0.9 * opacity);
  shapes.addDisc(pixel, kDotRadius * pixelRatio_, colour, opacity);
}

void SampleLayer::update(const Turntable& camera,
                         const std::function<bool(const Eigen::Vector3d&)>& hidden,
                         std::vector<PixelBox>& taken, FlatShapes& shapes) {
  const Eigen::Vector2d pad = kPlatePad * pixelRatio_;
  const Eigen::Vector2d edge = Eigen::Vector2d::Constant(kFromEdge * pixelRatio_);
  const Eigen::Vector2d picture(camera.width(), camera.height());
  std::vector<Eigen::Vector2d> points;
  for (const SampleLabel& label : labels_) {
    points.push_back(camera.toPixel(label.at));
    const Eigen::Vector2d& pixel = points.back();
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(kTriangle * pixelRatio_);
    if (pixel.allFinite()) taken.push_back({pixel - half, pixel + half});
  }
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const Eigen::Vector2d pixel = points[i];
    const Eigen::Vector2d size = texts_.extent(i) + 2 * pad;
    const bool isSeen =
        pixel.allFinite() && (pixel.array() >= 0).all() && (pixel.array() <= picture.array()).all();
    if (!isSeen || texts_.extent(i).isZero()) {
      texts_.hide(i);
      continue;
    }
    // The nearest place that is free; the first directions are up and to the right.
    PixelBox best{pixel, pixel};
    double least = std::numeric_limits<double>::infinity();
    for (const double distance : kDistances) {
      for (int k = 0; k < kDirections && least > 0; ++k) {
        const double angle = (0.75 + (k % 2 ? 1 : -1) * ((k + 1) / 2) * 0.5236);
        const Eigen::Vector2d way(std::cos(angle), -std::sin(angle));
        // The plate lies beyond the end of the line.
        const Eigen::Vector2d centre =
            pixel + distance * pixelRatio_ * way + (0.5 * size.array() * way.array()).matrix();
        Eigen::Vector2d low = centre - 0.5 * size;
        low = low.cwiseMax(edge).cwiseMin((picture - edge - size).cwiseMax(edge));
        const PixelBox box{low.array().round(), low.array().round().matrix() + size};
        const double overlap =
            clampedOverlap(box, taken) + 1e-3 * (low + 0.5 * size - centre).norm();
        const double cost = overlap < 1e-2 ? 0 : overlap;
        if (cost >= least) continue;
        least = cost;
        best = box;
      }
    }
    taken.push_back(best);
    const Colour colour = colourOf(labels_[i].kind);
    const double opacity = hidden(labels_[i].at) ? kHiddenOpacity : 1;
    const Eigen::Vector2d near = pixel.cwiseMax(best.low).cwiseMin(best.high);
    shapes.addLine(pixel, near, (kLine + 1.6) * pixelRatio_, theme_.backgroundBottom,
                   0.7 * opacity);
    shapes.addLine(pixel, near, kLine * pixelRatio_, colour, opacity);
    shapes.addPlate(best.low, best.high, colour, theme_, pixelRatio_, 0.9);
    texts_.place(i, best.low + pad, camera.height());
    drawPoint(pixel, labels_[i].kind, opacity, shapes);
  }
}

}  // namespace palpa::view

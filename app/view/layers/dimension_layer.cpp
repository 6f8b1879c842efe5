#include "app/view/layers/dimension_layer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace palpa::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kOffset = 30;    // of a dimension line from the measured points
constexpr double kGap = 4;        // between a measured point and its extension line
constexpr double kOvershoot = 5;  // of extension lines beyond the dimension line
constexpr double kTail = 16;      // of arrows that point from outside at a short distance
constexpr double kFromEdge = 6;
constexpr double kMinArc = 34;  // radius of the arc of an angle
constexpr double kLeader = 26;  // of a radius, outside the body
constexpr double kShort = 5;    // a shorter distance is seen end on
constexpr int kArcPieces = 40;

Vector2d across(const Vector2d& way) {
  return {-way.y(), way.x()};
}

/// The part of a line inside a rectangle from 0 to `size`, shrunk by `margin` (Liang and Barsky).
std::optional<std::array<Vector2d, 2>> clipped(const Vector2d& a, const Vector2d& b,
                                               const Vector2d& size, double margin) {
  double enter = 0, leave = 1;
  for (int k = 0; k < 2; ++k) {
    const double way = b[k] - a[k];
    const double low = margin - a[k], high = size[k] - margin - a[k];
    if (way == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    enter = std::max(enter, std::min(low / way, high / way));
    leave = std::min(leave, std::max(low / way, high / way));
  }
  if (enter > leave) return std::nullopt;
  return std::array<Vector2d, 2>{a + enter * (b - a), a + leave * (b - a)};
}

}  // namespace

/// What the parts of a dimension are laid out in, device pixels.
struct DimensionLayer::Frame {
  const Turntable& camera;
  Vector2d centre, picture;  // the middle of the body, and the size of the picture
};

void DimensionLayer::set(const std::vector<Dimension>& dimensions, const ViewportTheme& theme,
                         double pixelRatio) {
  dimensions_ = dimensions;
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  plates_.clear();
  std::vector<std::string> texts;
  for (const Dimension& dimension : dimensions) texts.push_back(dimension.text);
  texts_.set(texts, {kFontSize * pixelRatio, false, theme.text});
}

std::optional<DimensionLayer::PlateWish> DimensionLayer::drawLinear(const Dimension& dimension,
                                                                    const Frame& frame,
                                                                    DimensionPen& pen) const {
  const Vector2d a = frame.camera.toPixel(dimension.points[0]);
  const Vector2d b = frame.camera.toPixel(dimension.points[1]);
  if (!a.allFinite() || !b.allFinite()) return std::nullopt;
  const double unit = pen.unit(), length = (b - a).norm();
  pen.dot(a);
  pen.dot(b);
  if (length < kShort * unit) return PlateWish{a, {1, -1}, true};
  const Vector2d way = (b - a) / length;
  // Away from the middle of the body, unless that side of the picture ends there.
  Vector2d side = across(way);
  if (side.dot(0.5 * (a + b) - frame.centre) < 0) side = -side;
  const auto seen = [&](const Vector2d& by) {
    const auto part = clipped(a + by, b + by, frame.picture, kFromEdge * unit);
    return part ? ((*part)[1] - (*part)[0]).norm() : 0.0;
  };
  const Vector2d wished = kOffset * unit * side;
  if (seen(wished) < 0.5 * length && seen(-wished) > seen(wished)) side = -side;
  const Vector2d by = kOffset * unit * side;
  for (const Vector2d& end : {a, b})
    pen.line(end + kGap * unit * side, end + by + kOvershoot * unit * side, 1);
  const Vector2d from = a + by, to = b + by;
  const bool isShort = length < 2.6 * DimensionPen::kArrow * unit;
  if (isShort) {
    pen.line(from - kTail * unit * way, from);
    pen.line(to, to + kTail * unit * way);
    pen.arrow(from, way);
    pen.arrow(to, -way);
  } else {
    pen.line(from, to);
    pen.arrow(from, -way);
    pen.arrow(to, way);
  }
  const auto part = clipped(from, to, frame.picture, kFromEdge * unit);
  if (!part) return std::nullopt;
  if (isShort)
    return PlateWish{0.5 * (from + to) + DimensionPen::kHalfArrow * unit * side, side, true};
  return PlateWish{0.5 * ((*part)[0] + (*part)[1]), (*part)[1] - (*part)[0], false};
}

std::optional<DimensionLayer::PlateWish> DimensionLayer::drawAngle(const Dimension& dimension,
                                                                   const Frame& frame,
                                                                   DimensionPen& pen) const {
  const Vector3d corner = dimension.points[0];
  const Vector3d first = dimension.points[1] - corner, second = dimension.points[2] - corner;
  const Vector2d at = frame.camera.toPixel(corner);
  if (!(first.norm() > 0) || !(second.norm() > 0) || !at.allFinite()) return std::nullopt;
  const double scale = frame.camera.pixelsPerLength(frame.camera.depth(corner));
  const double radius =
      std::max(0.7 * std::min(first.norm(), second.norm()), kMinArc * pen.unit() / scale);
  const Vector3d u = first.normalized();
  Vector3d v = second - second.dot(u) * u;
  const double angle = std::atan2(v.norm(), second.dot(u));
  v = v.norm() > 1e-12 * second.norm() ? Vector3d(v.normalized()) : u.unitOrthogonal();
  const auto point = [&](double turn, double r) {
    return frame.camera.toPixel(corner + r * (std::cos(turn) * u + std::sin(turn) * v));
  };
  for (const double turn : {0.0, angle}) pen.line(at, point(turn, 1.12 * radius), 1);
  std::vector<Vector2d> arc;
  double length = 0;
  for (int k = 0; k <= kArcPieces; ++k) {
    arc.push_back(point(angle * k / kArcPieces, radius));
    if (k > 0) length += (arc[k] - arc[k - 1]).norm();
  }
  for (int k = 1; k <= kArcPieces; ++k) pen.line(arc[k - 1], arc[k]);
  if (length > 2.6 * DimensionPen::kArrow * pen.unit()) {
    // An arrow follows the chord that is as long as its head.
    const auto chord = [&](bool atEnd) {
      const Vector2d tip = atEnd ? arc.back() : arc.front();
      for (int k = 1; k <= kArcPieces; ++k) {
        const Vector2d& other = arc[atEnd ? kArcPieces - k : k];
        if ((tip - other).norm() >= DimensionPen::kArrow * pen.unit()) return Vector2d(tip - other);
      }
      return Vector2d(Vector2d::Zero());
    };
    pen.arrow(arc.front(), chord(false));
    pen.arrow(arc.back(), chord(true));
  }
  const Vector2d mid = arc[kArcPieces / 2];
  if (!mid.allFinite()) return std::nullopt;
  const Vector2d outwards = mid - at;
  return PlateWish{mid, outwards.norm() > 1 ? outwards : Vector2d(1, -1), true};
}

std::optional<DimensionLayer::PlateWish> DimensionLayer::drawRadius(const Dimension& dimension,
                                                                    const Frame& frame,
                                                                    DimensionPen& pen) const {
  const Vector2d place = frame.camera.toPixel(dimension.points[0]);
  if (!place.allFinite()) return std::nullopt;
  const Vector2d centre = frame.camera.toPixel(dimension.points[1]);
  Vector2d way = place - (centre.allFinite() ? centre : place);
  const double length = way.norm();
  if (length < kShort * pen.unit()) {
    pen.dot(place);
    return PlateWish{place, {1, -1}, true};
  }
  way /= length;
  const Vector2d free = place + kLeader * pen.unit() * way;
  const double reach = (frame.picture.norm()) * 2;  // a centre far away needs no longer line
  pen.line(place - std::min(length, reach) * way, free);
  if (length < reach) pen.dot(centre);
  pen.arrow(place, length > 1.5 * DimensionPen::kArrow * pen.unit() ? way : -way);
  return PlateWish{free, way, true};
}

std::optional<DimensionLayer::PlateWish> DimensionLayer::drawCurve(const Dimension& dimension,
                                                                   const Frame& frame,
                                                                   DimensionPen& pen) const {
  std::vector<Vector2d> line;
  for (const Vector3d& point : dimension.points) line.push_back(frame.camera.toPixel(point));
  std::vector<Vector2d> seen;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (k > 0) pen.line(line[k - 1], line[k], 2 * DimensionPen::kLine);
    const bool isIn = line[k].allFinite() && (line[k].array() >= 0).all() &&
                      (line[k].array() <= frame.picture.array()).all();
    if (isIn) seen.push_back(line[k]);
  }
  pen.dot(line.front());
  pen.dot(line.back());
  if (seen.empty()) return std::nullopt;
  const Vector2d mid = seen[seen.size() / 2];
  const Vector2d out = mid - frame.centre;
  return PlateWish{mid, out.norm() > 1 ? out : Vector2d(1, -1), true};
}

PixelBox DimensionLayer::placePlate(std::size_t index, const PlateWish& wish,
                                    const Vector2d& picture,
                                    const std::vector<PixelBox>& taken) const {
  const Vector2d size = texts_.extent(index) + 2 * kPlatePad * pixelRatio_;
  const Vector2d edge = Vector2d::Constant(kFromEdge * pixelRatio_);
  const Vector2d way = wish.way.normalized();
  std::vector<Vector2d> centres;
  if (wish.isBeside) {
    // The plate begins at the end of the line, turned further and further, then farther away.
    for (const double distance : {3.0, 28.0, 60.0, 100.0})
      for (int k = 0; k < 9; ++k) {
        const double turn = (k % 2 ? 1 : -1) * ((k + 1) / 2) * 0.6;
        const Vector2d d = std::cos(turn) * way + std::sin(turn) * across(way);
        centres.emplace_back(wish.mid + distance * pixelRatio_ * d +
                             (0.5 * size.array() * d.array()).matrix());
      }
  } else {
    for (const double aside : {0.0, 1.0, -1.0, 2.0, -2.0})
      for (const double share : {0.0, 0.15, -0.15, 0.3, -0.3})
        centres.emplace_back(wish.mid + share * wish.way +
                             aside * (std::abs(across(way).dot(size)) * 0.6 + 14 * pixelRatio_) *
                                 across(way));
  }
  PixelBox best{wish.mid, wish.mid};
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& centre : centres) {
    const Vector2d low =
        (centre - 0.5 * size).cwiseMax(edge).cwiseMin((picture - edge - size).cwiseMax(edge));
    const PixelBox box{low.array().round(), low.array().round().matrix() + size};
    double cost = 1e-3 * (low + 0.5 * size - centre).norm();
    for (const PixelBox& other : taken) cost += box.overlap(other);
    if (cost < least - 1e-2) {
      least = cost;
      best = box;
    }
    if (least < 1e-2) break;
  }
  return best;
}

void DimensionLayer::update(const Turntable& camera, const Vector3d& centre,
                            std::vector<PixelBox>& taken, FlatShapes& shapes) {
  const Vector2d picture(camera.width(), camera.height());
  Vector2d middle = camera.toPixel(centre);
  if (!middle.allFinite()) middle = 0.5 * picture;
  const Frame frame{camera, middle, picture};
  plates_.assign(dimensions_.size(), {Vector2d::Zero(), Vector2d::Zero()});
  for (std::size_t i = 0; i < dimensions_.size(); ++i) {
    const Dimension& dimension = dimensions_[i];
    if (!visible_ || dimension.points.empty()) {
      texts_.hide(i);
      continue;
    }
    const Colour colour = dimension.state == Dimension::State::kSelected  ? theme_.selected
                          : dimension.state == Dimension::State::kPreview ? theme_.preview
                                                                          : theme_.text;
    DimensionPen pen(shapes, colour, theme_.backgroundBottom, pixelRatio_);
    std::optional<PlateWish> wish;
    const std::size_t count = dimension.points.size();
    if (dimension.kind == Dimension::Kind::kCurve && count > 1)
      wish = drawCurve(dimension, frame, pen);
    else if (dimension.kind == Dimension::Kind::kAngle && count > 2)
      wish = drawAngle(dimension, frame, pen);
    else if (dimension.kind == Dimension::Kind::kRadius && count > 1)
      wish = drawRadius(dimension, frame, pen);
    else if (count > 1)
      wish = drawLinear(dimension, frame, pen);
    else if (const Vector2d at = camera.toPixel(dimension.points[0]); at.allFinite()) {
      pen.dot(at);
      wish = PlateWish{at + 2 * DimensionPen::kDot * pixelRatio_ * Vector2d(1, -1), {1, -1}, true};
    }
    pen.finish();
    if (!wish || texts_.extent(i).isZero()) {
      texts_.hide(i);
      continue;
    }
    const PixelBox plate = placePlate(i, *wish, picture, taken);
    // A plate that had to dodge keeps a line to its dimension.
    const Vector2d near = wish->mid.cwiseMax(plate.low).cwiseMin(plate.high);
    if ((near - wish->mid).norm() > 8 * pixelRatio_)
      shapes.addLine(wish->mid, near, pixelRatio_, colour, 0.8);
    taken.push_back(plate);
    plates_[i] = plate;
    shapes.addPlate(plate.low, plate.high, colour, theme_, pixelRatio_, 0.9);
    texts_.place(i, plate.low + kPlatePad * pixelRatio_, camera.height());
  }
}

std::optional<int> DimensionLayer::at(const Vector2d& pixel) const {
  for (std::size_t i = plates_.size(); i-- > 0;)
    if ((pixel.array() >= plates_[i].low.array()).all() &&
        (pixel.array() <= plates_[i].high.array()).all() && plates_[i].high != plates_[i].low)
      return static_cast<int>(i);
  return std::nullopt;
}

}  // namespace palpa::view

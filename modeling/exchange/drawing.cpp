#include "modeling/exchange/drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/text_file.h"
#include "modeling/shapes/shape_parameters.h"

namespace palpa::modeling {

using Eigen::Vector2d;

Vector2d DrawnPiece::at(double t) const {
  const double s = 1.0 - t;
  return s * s * s * points[0] + 3.0 * s * s * t * points[1] + 3.0 * s * t * t * points[2] +
         t * t * t * points[3];
}

namespace {

std::string endingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

/// Largest distance of control points from the beginning of a path, mm: the scale of rounding
/// errors.
double reachOf(const DrawnPath& path) {
  double reach = 0.0;
  for (const DrawnPiece& piece : path.pieces)
    for (const Vector2d& p : piece.points) reach = std::max(reach, (p - path.start()).norm());
  return reach;
}

}  // namespace

bool isDrawingFile(const std::filesystem::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".dxf" || ending == ".svg";
}

Drawing readDrawing(const std::filesystem::path& path, const Job& job) {
  if (!isDrawingFile(path))
    throw ModelingError(path.string() + ": the name must end in .dxf or .svg");
  const std::string text = readTextFile(path, kMaxDrawingFile);
  return endingOf(path) == ".dxf" ? readDxf(text, path.string(), job)
                                  : readSvg(text, path.string(), job);
}

void DrawingBuilder::begin(const std::string& place, const std::string& layer,
                           const Eigen::Affine2d& toMm) {
  end();
  place_ = place;
  layer_ = layer;
  toMm_ = toMm;
}

void DrawingBuilder::add(const std::array<Vector2d, 4>& points, bool isStraight) {
  if (++pieces_ > kMaxDrawnPieces)
    throw ModelingError(place_ + ": the drawing has more than " + std::to_string(kMaxDrawnPieces) +
                            " lines and curves; leave out what does not belong to the profile",
                        ModelingError::Kind::kTooLarge);
  DrawnPiece piece{points, isStraight};
  for (Vector2d& p : piece.points) {
    p = toMm_ * p;
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kMaxLength)
      throw ModelingError(place_ + ": the curve goes beyond ±" + numberText(kMaxLength) + " mm");
  }
  if (!isOpen_) start_ = position_;
  isOpen_ = true;
  position_ = points[3];
  if (path_.pieces.empty()) {
    path_.layer = layer_;
    path_.origin = place_;
  }
  path_.pieces.push_back(piece);
}

void DrawingBuilder::moveTo(const Vector2d& p) {
  end();
  start_ = position_ = p;
  isOpen_ = true;
}

void DrawingBuilder::lineTo(const Vector2d& p) {
  if (p == position_) return;
  const Vector2d third = (p - position_) / 3.0;
  add({position_, position_ + third, p - third, p}, true);
}

void DrawingBuilder::quadTo(const Vector2d& control, const Vector2d& p) {
  cubicTo(position_ + 2.0 / 3.0 * (control - position_), p + 2.0 / 3.0 * (control - p), p);
}

void DrawingBuilder::cubicTo(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  if (a == position_ && b == p) {
    lineTo(p);
    return;
  }
  add({position_, a, b, p}, false);
}

void DrawingBuilder::arc(const Vector2d& centre, const Vector2d& u, const Vector2d& v, double from,
                         double to) {
  // A piece of 30° deviates by 7e-7 of the radius.
  constexpr double kPiece = std::numbers::pi / 6.0;
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / kPiece - 1e-9)));
  const double step = (to - from) / count;
  const double handle = 4.0 / 3.0 * std::tan(0.25 * step);
  const auto point = [&](double angle) -> Vector2d {
    return centre + std::cos(angle) * u + std::sin(angle) * v;
  };
  const auto tangent = [&](double angle) -> Vector2d {
    return std::cos(angle) * v - std::sin(angle) * u;
  };
  if (!isOpen_) moveTo(point(from));
  for (int i = 0; i < count; ++i) {
    const double a = from + i * step, b = i + 1 == count ? to : from + (i + 1) * step;
    add({position_, position_ + handle * tangent(a), point(b) - handle * tangent(b), point(b)},
        false);
  }
}

void DrawingBuilder::close() {
  if (!isOpen_) return;
  // Rounding in arcs must not leave a tiny line.
  if (!path_.pieces.empty() && (toMm_ * start_ - path_.end()).norm() > 1e-9 * reachOf(path_))
    lineTo(start_);
  if (!path_.pieces.empty()) {
    path_.pieces.back().points[3] = path_.start();
    path_.closed = true;
  }
  const Vector2d start = start_;
  end();
  // SVG continues at the start of the closed path.
  start_ = position_ = start;
}

void DrawingBuilder::end() {
  if (!path_.pieces.empty()) {
    if ((path_.end() - path_.start()).norm() <= 1e-9 * reachOf(path_)) {
      path_.pieces.back().points[3] = path_.start();
      path_.closed = true;
    }
    paths_.push_back(std::move(path_));
  }
  path_ = {};
  isOpen_ = false;
}

std::vector<DrawnPath> DrawingBuilder::take() {
  end();
  return std::move(paths_);
}

}  // namespace palpa::modeling

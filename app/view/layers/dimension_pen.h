#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/view/layers/flat_shapes.h"

/// Strokes of dimensions. Internal to app/view.
namespace palpa::view {

/// Draws lines, arrow heads and dots in one colour, with a halo that separates them from any
/// ground. Halos are drawn at once and the colours by finish(), so that no halo covers a stroke of
/// the same pen. Points that are not finite (behind the eye) are left out.
class DimensionPen {
 public:
  // In logical pixels.
  static constexpr double kLine = 1.5;       // width
  static constexpr double kArrow = 10;       // length of a head
  static constexpr double kHalfArrow = 3.2;  // half of its width
  static constexpr double kDot = 3.2;        // radius

  /// `unit`: device pixels per logical pixel. `shapes` must outlive the pen.
  DimensionPen(FlatShapes& shapes, const Colour& colour, const Colour& halo, double unit)
      : shapes_(shapes), colour_(colour), halo_(halo), unit_(unit) {}

  double unit() const { return unit_; }

  /// Places are in device pixels, widths in logical ones.
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width = kLine);
  /// Head with its tip at `tip`, pointing along `way`, which need not be normalised.
  void arrow(const Eigen::Vector2d& tip, const Eigen::Vector2d& way);
  void dot(const Eigen::Vector2d& at);
  /// Draws the colours over all halos.
  void finish();

 private:
  struct Stroke {
    Eigen::Vector2d a, b;
    double width;
  };

  FlatShapes& shapes_;
  Colour colour_, halo_;
  double unit_;
  std::vector<Stroke> lines_;
  std::vector<std::vector<Eigen::Vector2d>> heads_;
  std::vector<Eigen::Vector2d> dots_;
};

}  // namespace palpa::view

#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/view/rectangle.h"

/// Finding room for labels. Internal to app/view; pure arithmetic, no VTK objects.
namespace palpa::view {

/// How much it hurts to write over something: over the body a label is still readable on a light
/// ground; over arrows and other labels it is not.
enum class Cover { kNothing = 0, kBody = 1, kMark = 6 };

/// What covers the picture, as a coarse grid of cells.
class Occupancy {
 public:
  /// All free. `cell` is the side of a cell in pixels, > 0.
  Occupancy(int width, int height, double cell);

  // Each covers cells; a stronger cover replaces a weaker one.
  void addTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   Cover cover);
  void addSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Cover cover);
  void addRectangle(const Rectangle& rectangle, Cover cover);

  /// The mean cover within `rectangle`, 0 (free) … 6.
  double meanCover(const Rectangle& rectangle) const;

 private:
  void mark(int column, int row, Cover cover);

  double cell_;
  int columns_;
  int rows_;
  std::vector<Cover> cells_;
};

/// A label that wants to be near `anchor`, best in the direction `towards` from it.
struct LabelWish {
  Eigen::Vector2d anchor;
  Eigen::Vector2d towards;  ///< any length; zero when there is no preference
  Eigen::Vector2d size;     ///< pixels
  double gap = 8;           ///< smallest distance between anchor and label, pixels
};

/// The rectangle within `bounds` with the least overlap, close to the anchor.
Rectangle placeLabel(const LabelWish& wish, const Rectangle& bounds, const Occupancy& occupancy);

}  // namespace palpa::view

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "app/view/camera/turntable.h"

/// Room for the labels of arrows. Internal to app/view; pure arithmetic.
namespace palpa::view {

/// A rectangle of the picture; pixels from its top left corner.
struct PixelBox {
  Eigen::Vector2d low, high;

  /// The area that both cover.
  double overlap(const PixelBox& other) const;
};

/// The ends of an arrow as pixels.
struct SeenArrow {
  Eigen::Vector2d held, free;
};

/// The part of an arrow from its held end on that lies in the picture; all of it if no end does.
/// None if an end has no place (NaN).
std::optional<SeenArrow> seenPart(const Eigen::Vector2d& held, const Eigen::Vector2d& free,
                                  const Eigen::Vector2d& picture);

/// Share of an arrow, from its held end on, that ends `margin` pixels inside the picture: 1 if all
/// of it does, or if the held end is not in the picture; at least a tenth.
double shareInPicture(const Turntable& camera, const Eigen::Vector3d& held,
                      const Eigen::Vector3d& free, double margin);

/// Adds the area of the arrow, as small squares along it.
void addArrowCover(const SeenArrow& arrow, double width, std::vector<PixelBox>& taken);

/// A label for the end of an arrow.
struct ArrowLabelWish {
  Eigen::Vector2d end;    ///< pixel
  Eigen::Vector2d along;  ///< direction in which the arrow points there; any length
  Eigen::Vector2d size;   ///< pixels
};

/// Place of a label, and its number in the order of places tried.
struct ArrowLabelPlace {
  PixelBox box;
  int choice = 0;
};

/// The place of a label: in front of the end of its arrow, `gap` pixels away; if this covers one of
/// `taken`, turned to the side in steps or further away; without a free place, the one that covers
/// least. Inside a picture of `picture` pixels if the end of the arrow is.
///
/// `before`: the choice in the previous picture, if any. It is kept while it is free, and left only
/// for a place that stays free if others come nearer by a gap, so that labels do not jump while
/// arrows move.
ArrowLabelPlace placeArrowLabel(const ArrowLabelWish& wish, const Eigen::Vector2d& picture,
                                double gap, const std::vector<PixelBox>& taken,
                                std::optional<int> before = {});

}  // namespace palpa::view

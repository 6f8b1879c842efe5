#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

/// Room for the labels of arrows in the interactive view. Internal to app/view; pure arithmetic.
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

/// The part of an arrow from its held end on that lies in the picture; all of it when no end does.
/// None when an end has no place (NaN).
std::optional<SeenArrow> seenPart(const Eigen::Vector2d& held, const Eigen::Vector2d& free,
                                  const Eigen::Vector2d& picture);

/// Adds what the arrow covers, as small squares along it.
void addArrowCover(const SeenArrow& arrow, double width, std::vector<PixelBox>& taken);

/// A label that wants to stand at the end of an arrow.
struct ArrowLabelWish {
  Eigen::Vector2d end;    ///< pixel
  Eigen::Vector2d along;  ///< direction in which the arrow points there; any length
  Eigen::Vector2d size;   ///< pixels
};

/// Where a label stands, and as the how manieth of the places tried that is.
struct ArrowLabelPlace {
  PixelBox box;
  int choice = 0;
};

/// The place of a label: in front of the end of its arrow, `gap` pixels away, or else, where that
/// covers one of `taken`, turned to the side in steps or further away; where the least is covered
/// when there is no free place. Within a picture of `picture` pixels as long as the arrow's end is.
///
/// `before`: the choice in the picture before, if any. It is kept while it is free, and left only
/// for a place that stays free when others come nearer by a gap, so that labels do not jump to and
/// fro while arrows move.
ArrowLabelPlace placeArrowLabel(const ArrowLabelWish& wish, const Eigen::Vector2d& picture,
                                double gap, const std::vector<PixelBox>& taken,
                                std::optional<int> before = {});

}  // namespace palpa::view

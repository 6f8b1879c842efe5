#include "app/view/arrow_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>

namespace palpa::view {

double PixelBox::overlap(const PixelBox& other) const {
  const Eigen::Vector2d common = high.cwiseMin(other.high) - low.cwiseMax(other.low);
  return std::max(0.0, common.x()) * std::max(0.0, common.y());
}

PixelBox placeArrowLabel(const ArrowLabelWish& wish, const Eigen::Vector2d& picture, double gap,
                         const std::vector<PixelBox>& taken) {
  const Eigen::Vector2d ahead =
      wish.along.norm() > 0 ? Eigen::Vector2d(wish.along.normalized()) : Eigen::Vector2d(0, -1);
  const Eigen::Vector2d half = 0.5 * wish.size;
  const bool endIsSeen =
      (wish.end.array() >= 0).all() && (wish.end.array() <= picture.array()).all();
  PixelBox best{wish.end, wish.end};
  double least = std::numeric_limits<double>::infinity();
  for (const double distance : {1.0, 2.2, 4.0}) {
    // No further back than to the side: there lies the arrow.
    for (const int step : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
      const Eigen::Vector2d away = Eigen::Rotation2Dd(step * std::numbers::pi / 8) * ahead;
      // The label touches a circle about the end, in that direction.
      Eigen::Vector2d center = wish.end + distance * gap * away + half.cwiseProduct(away);
      if (endIsSeen) center = center.cwiseMin(picture - half).cwiseMax(half);
      const PixelBox box{(center - half).array().round(), (center + half).array().round()};
      double covered = 0;
      for (const PixelBox& other : taken) covered += box.overlap(other);
      if (covered >= least) continue;
      least = covered;
      best = box;
      if (least == 0) return best;
    }
  }
  return best;
}

}  // namespace palpa::view

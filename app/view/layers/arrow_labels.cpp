#include "app/view/layers/arrow_labels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>

namespace palpa::view {
namespace {

bool isInside(const Eigen::Vector2d& pixel, const Eigen::Vector2d& picture) {
  return (pixel.array() >= 0).all() && (pixel.array() <= picture.array()).all();
}

}  // namespace

double PixelBox::overlap(const PixelBox& other) const {
  const Eigen::Vector2d common = high.cwiseMin(other.high) - low.cwiseMax(other.low);
  return std::max(0.0, common.x()) * std::max(0.0, common.y());
}

std::optional<SeenArrow> seenPart(const Eigen::Vector2d& held, const Eigen::Vector2d& free,
                                  const Eigen::Vector2d& picture) {
  if (!held.allFinite() || !free.allFinite()) return std::nullopt;
  if (!isInside(held, picture) || isInside(free, picture)) return SeenArrow{held, free};
  double share = 1;
  for (Eigen::Index k = 0; k < 2; ++k) {
    if (free[k] < 0) share = std::min(share, held[k] / (held[k] - free[k]));
    if (free[k] > picture[k]) share = std::min(share, (picture[k] - held[k]) / (free[k] - held[k]));
  }
  return SeenArrow{held, held + share * (free - held)};
}

double shareInPicture(const Turntable& camera, const Eigen::Vector3d& held,
                      const Eigen::Vector3d& free, double margin) {
  constexpr double kMinShare = 0.1;
  constexpr double kNearest =
      0.2;  // of the depth of the held end: no arrow comes nearer to the eye
  const Eigen::Vector2d picture(camera.width(), camera.height());
  const Eigen::Vector2d start = camera.toPixel(held);
  if (!start.allFinite() || !isInside(start, picture)) return 1;
  const double from = camera.parallel() ? 1 : camera.depth(held);
  double to = camera.parallel() ? 1 : camera.depth(free);
  double cut = 1;
  if (to < kNearest * from) {
    cut = (1 - kNearest) * from / (from - to);
    to = kNearest * from;
  }
  const Eigen::Vector2d end = camera.toPixel(held + cut * (free - held));
  double seen = 1;  // in the picture, where it shrinks with the depth
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double least = std::min(margin, start[k]);
    const double most = std::max(picture[k] - margin, start[k]);
    if (end[k] < least) seen = std::min(seen, (start[k] - least) / (start[k] - end[k]));
    if (end[k] > most) seen = std::min(seen, (most - start[k]) / (end[k] - start[k]));
  }
  return std::max(kMinShare, cut * seen * from / (to - seen * (to - from)));
}

void addArrowCover(const SeenArrow& arrow, double width, std::vector<PixelBox>& taken) {
  constexpr int kMaxSteps = 24;
  const Eigen::Vector2d along = arrow.free - arrow.held;
  const int count = std::clamp(static_cast<int>(along.norm() / width), 1, kMaxSteps);
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * width);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d center = arrow.held + (i + 0.5) / count * along;
    taken.push_back({center - half, center + half});
  }
}

ArrowLabelPlace placeArrowLabel(const ArrowLabelWish& wish, const Eigen::Vector2d& picture,
                                double gap, const std::vector<PixelBox>& taken,
                                std::optional<int> before) {
  constexpr double kBetter = 0.7;  // of the area that the previous place covers: worth moving
  const Eigen::Vector2d ahead =
      wish.along.norm() > 0 ? Eigen::Vector2d(wish.along.normalized()) : Eigen::Vector2d(0, -1);
  const Eigen::Vector2d half = 0.5 * wish.size;
  const bool endIsSeen = isInside(wish.end, picture);
  ArrowLabelPlace best{{wish.end, wish.end}, 0};
  double least = std::numeric_limits<double>::infinity();
  int choice = -1;
  for (const double distance : {1.0, 2.2, 4.0, 7.0}) {
    // No further back than to the side: the arrow lies there.
    for (const int step : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
      ++choice;
      const Eigen::Vector2d away = Eigen::Rotation2Dd(step * std::numbers::pi / 8) * ahead;
      // The label touches a circle about the end, in that direction.
      Eigen::Vector2d center = wish.end + distance * gap * away + half.cwiseProduct(away);
      if (endIsSeen) center = center.cwiseMin(picture - half).cwiseMax(half);
      const PixelBox box{(center - half).array().round(), (center + half).array().round()};
      const bool isBefore = choice == before;
      PixelBox needed = box;
      if (before && !isBefore) {
        needed.low.array() -= gap;
        needed.high.array() += gap;
      }
      double covered = 0;
      for (const PixelBox& other : taken) covered += needed.overlap(other);
      if (isBefore) covered *= kBetter;
      if (covered >= least) continue;
      least = covered;
      best = {box, choice};
      if (least == 0) return best;
    }
  }
  return best;
}

}  // namespace palpa::view

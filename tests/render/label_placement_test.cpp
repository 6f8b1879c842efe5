#include "app/view/label_placement.h"

#include <gtest/gtest.h>

#include <vector>

namespace palpa::view {
namespace {

const Rectangle kPicture{0, 0, 400, 300};

bool inside(const Rectangle& inner, const Rectangle& outer) {
  return inner.left >= outer.left && inner.right <= outer.right && inner.bottom >= outer.bottom &&
         inner.top <= outer.top;
}

TEST(LabelPlacement, FollowsTheWishWhereThereIsRoom) {
  const Occupancy empty(400, 300, 4);
  const Rectangle label = placeLabel({{200, 150}, {1, 0}, {60, 20}, 8}, kPicture, empty);
  EXPECT_GT(label.left, 200);
  EXPECT_NEAR(0.5 * (label.bottom + label.top), 150, 1);
  EXPECT_DOUBLE_EQ(label.width(), 60);
}

TEST(LabelPlacement, AvoidsWhatIsTaken) {
  Occupancy occupancy(400, 300, 4);
  occupancy.addRectangle({205, 0, 399, 299}, Cover::kBody);
  const Rectangle label = placeLabel({{200, 150}, {1, 0}, {60, 20}, 8}, kPicture, occupancy);
  EXPECT_EQ(occupancy.meanCover(label), 0);
}

TEST(LabelPlacement, StaysInThePicture) {
  const Occupancy empty(400, 300, 4);
  for (const auto& anchor :
       std::vector<Eigen::Vector2d>{{0, 0}, {399, 299}, {399, 0}, {-50, 150}}) {
    const Rectangle label = placeLabel({anchor, {0, 1}, {60, 20}, 8}, kPicture, empty);
    EXPECT_TRUE(inside(label, kPicture)) << anchor.transpose();
  }
}

TEST(Occupancy, FillsTrianglesAndIgnoresWhatLiesOutside) {
  Occupancy occupancy(400, 300, 4);
  occupancy.addTriangle({-1000, -1000}, {100, 0}, {0, 100}, Cover::kBody);
  occupancy.addTriangle({1e5, 1e5}, {2e5, 1e5}, {1e5, 2e5}, Cover::kBody);
  EXPECT_EQ(occupancy.meanCover({8, 8, 30, 30}), 1);
  EXPECT_EQ(occupancy.meanCover({200, 200, 300, 290}), 0);
}

}  // namespace
}  // namespace palpa::view

#include "balance.h"

#include <gtest/gtest.h>

namespace palpa::bem {
namespace {

// Limits: 1 % at 600 nodes, 0.3 % at 2,500 (slow tests).
TEST(Balance, SphereIsWithinOnePercentAt600NodesAndImproves) {
  const auto coarse = test::sphereBalance(7), fine = test::sphereBalance(10);
  EXPECT_LE(fine.force, 0.01);
  EXPECT_LE(fine.moment, 0.01);
  EXPECT_LT(fine.force, coarse.force);
}

TEST(Balance, CylinderIsWithinOnePercentAt600NodesAndImproves) {
  const auto coarse = test::cylinderBalance(24), fine = test::cylinderBalance(32);
  EXPECT_LE(fine.force, 0.01);
  EXPECT_LE(fine.moment, 0.01);
  EXPECT_LT(fine.force, coarse.force);
}

}  // namespace
}  // namespace palpa::bem

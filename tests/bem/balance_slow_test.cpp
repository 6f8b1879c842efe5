#include <gtest/gtest.h>

#include "balance.h"

namespace palpa::bem {
namespace {

TEST(BalanceFine, SphereIsWithinThreePerMilleAt2500Nodes) {
  const auto coarse = test::sphereBalance(10), fine = test::sphereBalance(20);
  EXPECT_LE(fine.force, 0.003);
  EXPECT_LE(fine.moment, 0.003);
  EXPECT_LT(fine.force, coarse.force);
}

TEST(BalanceFine, CylinderIsWithinThreePerMilleAt2500Nodes) {
  const auto coarse = test::cylinderBalance(32), fine = test::cylinderBalance(64);
  EXPECT_LE(fine.force, 0.003);
  EXPECT_LE(fine.moment, 0.003);
  EXPECT_LT(fine.force, coarse.force);
}

}  // namespace
}  // namespace palpa::bem

#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace palpa::test {
namespace {

TEST(DisjointSets, ChainsBecomeOneSetWhoseRootIsItsSmallestNumber) {
  constexpr int kSize = 1000;
  DisjointSets sets(kSize);
  EXPECT_EQ(sets.count(), kSize);
  // Even numbers, then odd ones, in an order that makes deep trees.
  for (int k = kSize - 1; k >= 2; --k) EXPECT_TRUE(sets.join(k, k - 2));
  EXPECT_EQ(sets.count(), 2);
  for (int k = 0; k < kSize; ++k) EXPECT_EQ(sets.rootOf(k), k % 2);
  EXPECT_FALSE(sets.join(10, 990));
  EXPECT_TRUE(sets.join(999, 4));
  EXPECT_EQ(sets.count(), 1);
  EXPECT_EQ(sets.rootOf(777), 0);
}

}  // namespace
}  // namespace palpa::test

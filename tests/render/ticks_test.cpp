#include "app/view/scene/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace palpa::view {
namespace {

using Labels = std::vector<std::string>;

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_EQ(niceTicks(0, 2.03, 5).labels, (Labels{"0.0", "0.5", "1.0", "1.5", "2.0"}));
  EXPECT_EQ(niceTicks(-0.4, 0.4, 4).labels, (Labels{"-0.4", "-0.2", "0.0", "0.2", "0.4"}));
  EXPECT_EQ(niceTicks(0, 10000, 4).labels, (Labels{"0", "2500", "5000", "7500", "10000"}));
}

TEST(Ticks, SmallAndLargeNumbersShareAFactor) {
  const Ticks small = niceTicks(0, 1.5e-6, 3);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(small.labels, (Labels{"0.0", "0.5", "1.0", "1.5"}));
  EXPECT_NEAR(small.values.back(), 1.5e-6, 1e-15);
  EXPECT_EQ(niceTicks(0, 3e7, 3).exponent, 6);
}

TEST(Ticks, FactorsOfTenAreUnitsOfTheirOwn) {
  EXPECT_EQ(scaledUnit("MPa", 0).name, "MPa");
  EXPECT_EQ(scaledUnit("MPa", -3).name, "kPa");
  EXPECT_EQ(scaledUnit("MPa", -3).exponent, -3);
  EXPECT_EQ(scaledUnit("mm", -3).name, "µm");
  EXPECT_EQ(scaledUnit("N/mm", 3).name, "kN/mm");
  // Without a name the factor stays, and extremes are in the plain unit.
  EXPECT_EQ(scaledUnit("in", -3).name, "×10^-3 in");
  EXPECT_EQ(scaledUnit("in", -3).exponent, 0);
  EXPECT_EQ(scaledUnit("", 6).name, "×10^6");
}

TEST(Ticks, AnEmptyOrBrokenRangeGivesOneTick) {
  EXPECT_EQ(niceTicks(2, 2, 5).labels, (Labels{"2.00"}));
  EXPECT_EQ(niceTicks(0, 0, 5).labels, (Labels{"0"}));
  EXPECT_EQ(niceTicks(0, std::nan(""), 5).values.size(), 1u);
  EXPECT_EQ(niceTicks(0, std::numeric_limits<double>::infinity(), 5).values.size(), 1u);
}

TEST(LogarithmicTicks, AreFewAndSpreadEvenlyInRatios) {
  EXPECT_EQ(logarithmicTicks(0.4, 20, 7).labels, (Labels{"0.5", "1", "2", "3", "5", "10", "20"}));
  EXPECT_EQ(logarithmicTicks(0.4, 20, 6).labels, (Labels{"0.5", "1", "2", "5", "10", "20"}));
  EXPECT_EQ(logarithmicTicks(0.4, 20, 4).labels, (Labels{"1", "3", "10"}));
  EXPECT_EQ(logarithmicTicks(1, 1e6, 4).labels, (Labels{"1", "100", "10000", "1e+06"}));
  EXPECT_EQ(logarithmicTicks(1, 2, 8).labels, (Labels{"1", "1.5", "2"}));
  // No step lies between the ends.
  EXPECT_EQ(logarithmicTicks(2.1, 2.9, 4).labels, (Labels{"2.2", "2.4", "2.6", "2.8"}));
  EXPECT_EQ(logarithmicTicks(0, 1, 4).labels, niceTicks(0, 1, 4).labels);
}

TEST(ThreeDigits, KeepsThreeDigits) {
  EXPECT_EQ(threeDigits(0.13449), "0.134");
  EXPECT_EQ(threeDigits(12.345), "12.3");
  EXPECT_EQ(threeDigits(4567.8), "4568");
  EXPECT_EQ(threeDigits(-0.001), "-0.00100");
  EXPECT_EQ(threeDigits(1.2e-9), "1.20e-09");
  EXPECT_EQ(threeDigits(0), "0");
}

}  // namespace
}  // namespace palpa::view

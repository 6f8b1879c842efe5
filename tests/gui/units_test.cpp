#include "app/gui/units.h"

#include <gtest/gtest.h>

namespace palpa::gui {
namespace {

ShownUnits inCentimetresAndKilopascals() {
  ShownUnits units;
  units.chosen[static_cast<std::size_t>(Quantity::kLength)] = 1;
  units.chosen[static_cast<std::size_t>(Quantity::kStress)] = 1;
  return units;
}

TEST(Units, ShowValuesInTheChosenUnit) {
  EXPECT_EQ(shown(12.5, Quantity::kLength, {}), "12.5 mm");
  EXPECT_EQ(shown(12.5, Quantity::kLength, inCentimetresAndKilopascals()), "1.25 cm");
  EXPECT_EQ(shown(0.06, Quantity::kStress, inCentimetresAndKilopascals()), "60 kPa");
  EXPECT_EQ(shown(3.14159265358979, Quantity::kAngle, {}), "180°");
  EXPECT_EQ(shown(210000, Quantity::kStress, {}, 4), "210000 MPa");
  EXPECT_EQ(shown(123456.78, Quantity::kNumber, {}), "123457");
  EXPECT_EQ(shown(-0.0, Quantity::kNumber, {}), "0");
}

TEST(Units, ReadNumbersWithAndWithoutUnit) {
  EXPECT_DOUBLE_EQ(*parsed("2", Quantity::kLength, inCentimetresAndKilopascals()), 20);
  EXPECT_DOUBLE_EQ(*parsed(" 2.5mm ", Quantity::kLength, inCentimetresAndKilopascals()), 2.5);
  EXPECT_DOUBLE_EQ(*parsed("1,5", Quantity::kLength, {}), 1.5);
  EXPECT_DOUBLE_EQ(*parsed("3e-2 m", Quantity::kLength, {}), 30);
  EXPECT_DOUBLE_EQ(*parsed("250 mN", Quantity::kForce, {}), 0.25);
  EXPECT_NEAR(*parsed("180", Quantity::kAngle, {}), 3.14159265358979, 1e-14);
}

TEST(Units, RefuseWhatIsNoNumber) {
  for (const char* text : {"", "mm", "1 2", "1.2.3", "inf", "nan", "5 N", "1e999"})
    EXPECT_FALSE(parsed(text, Quantity::kLength, {})) << text;
}

}  // namespace
}  // namespace palpa::gui

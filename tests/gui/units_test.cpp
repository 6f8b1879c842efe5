#include "app/gui/base/units.h"

#include <gtest/gtest.h>

#include "app/gui/view/condition_marks.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/tessellation.h"

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
  // Rounding errors.
  EXPECT_EQ(shown(2.2204e-16, Quantity::kLength, {}, 10), "0 mm");
  EXPECT_EQ(shown(-1e-14, Quantity::kForce, {}), "0 N");
  EXPECT_EQ(shown(1e-9, Quantity::kLength, {}), "1e-09 mm");
}

TEST(Units, ReadNumbersWithAndWithoutUnit) {
  EXPECT_DOUBLE_EQ(*parsed("2", Quantity::kLength, inCentimetresAndKilopascals()), 20);
  EXPECT_DOUBLE_EQ(*parsed(" 2.5mm ", Quantity::kLength, inCentimetresAndKilopascals()), 2.5);
  EXPECT_DOUBLE_EQ(*parsed("1,5", Quantity::kLength, {}), 1.5);
  EXPECT_DOUBLE_EQ(*parsed("3e-2 m", Quantity::kLength, {}), 30);
  EXPECT_DOUBLE_EQ(*parsed("250 mN", Quantity::kForce, {}), 0.25);
  EXPECT_NEAR(*parsed("180", Quantity::kAngle, {}), 3.14159265358979, 1e-14);
}

TEST(Units, KnowMomentsAccelerationsAndDensities) {
  ShownUnits units;
  units.chosen[static_cast<std::size_t>(Quantity::kDensity)] = 1;
  EXPECT_EQ(shown(1070, Quantity::kDensity, units), "1.07 g/cm³");
  EXPECT_EQ(shown(-9.80665, Quantity::kAcceleration, {}, 3), "-9.81 m/s²");
  EXPECT_EQ(shown(30, Quantity::kMoment, {}), "30 N mm");
  EXPECT_DOUBLE_EQ(*parsed("2 N m", Quantity::kMoment, {}), 2000);
  EXPECT_DOUBLE_EQ(*parsed("2Nmm", Quantity::kMoment, {}), 2);
  EXPECT_DOUBLE_EQ(*parsed("1 g", Quantity::kAcceleration, {}), 9.80665);
  EXPECT_DOUBLE_EQ(*parsed("9810 mm/s^2", Quantity::kAcceleration, {}), 9.81);
  EXPECT_DOUBLE_EQ(*parsed("7.85 g/cm3", Quantity::kDensity, {}), 7850);
  EXPECT_DOUBLE_EQ(*parsed("7850 kg/m³", Quantity::kDensity, units), 7850);
  EXPECT_FALSE(parsed("1 kg", Quantity::kDensity, {}));
}

TEST(Units, RefuseWhatIsNoNumber) {
  for (const char* text : {"", "mm", "1 2", "1.2.3", "inf", "nan", "5 N", "1e999"})
    EXPECT_FALSE(parsed(text, Quantity::kLength, {})) << text;
}

TEST(Units, AreThoseOfTheStrengthsAtLoadArrows) {
  modeling::Project project;
  const modeling::Solid solid = modeling::makeSphere(20);
  project.body = solid;
  const auto everywhere = modeling::Region::below(Eigen::Vector3d::UnitZ(), 30);
  project.loads = {{"Suction", modeling::Pressure{everywhere, -0.06}},
                   {"Shear", modeling::UniformTraction{everywhere, {0.03, 0.04, 0}}},
                   {"Thumb", modeling::Bump{{0, 0, 20}, 5, 0.01, {0, 0, -2}}}};
  const modeling::Tessellation tessellation(solid);
  const auto shape = tessellation.evaluate(solid.controlPoints());
  const ShownSurface surface{shape.positions, tessellation.triangles(),
                             tessellation.patchOfTriangle()};
  const auto arrows = loadArrows(project, surface, inCentimetresAndKilopascals());
  ASSERT_EQ(arrows.size(), 3u);
  EXPECT_EQ(arrows[0].label, "Suction: -60 kPa");
  EXPECT_EQ(arrows[1].label, "Shear: 50 kPa");
  EXPECT_EQ(arrows[2].label, "Thumb: 20 kPa");
  EXPECT_EQ(loadArrows(project, surface, {})[2].label, "Thumb: 0.02 MPa");
}

}  // namespace
}  // namespace palpa::gui

#include "axisymmetric_sphere.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "modeling/project/project.h"

namespace palpa::app::test {
namespace {

// The sphere R = 25 mm, fixed below z = -20 mm, E = 0.1 MPa, nu = 0.45, 1200 kg/m^3, computed with
// quadratic tetrahedra in space (CalculiX 2.20, C3D10; meshes of TetGen 1.5 with middle nodes on
// the sphere and on the rim, edges of 1, 0.5 and 0.25 mm at the rim, growing by 0.25 per mm to 4, 3
// and 2.5 mm; 16,559, 43,023 and 79,972 elements). They share neither elements nor program with the
// axisymmetric solution. Both err from below; the differences between the meshes fall by 2.6
// to 2.9.
struct Places {
  double angle;
  std::array<double, 3> uz;  // mm, of the three meshes
};
constexpr Places kTetrahedra[] = {
    {0.902503240158, {-0.07662397, -0.07796917, -0.07848771}},
    {1.183088882469, {-0.09230746, -0.09374196, -0.09424280}},
    {1.580285438092, {-0.1028775, -0.1042372, -0.1047390}},
    {2.104884662499, {-0.1180049, -0.1193066, -0.1198110}},
    {2.718838699855, {-0.1365508, -0.1377956, -0.1382693}},
    {3.141592653590, {-0.1415315, -0.1427512, -0.1431890}},
};
constexpr std::array kEnergy{0.03662257, 0.03705757, 0.03721420};  // mJ

/// Limits of the values on finer and finer meshes: with the observed rate of the differences, and
/// with the rate 2 (first order), which the axisymmetric solution shows on its finest meshes.
std::pair<double, double> limits(const std::array<double, 3>& values) {
  const double last = values[2] - values[1], rate = (values[1] - values[0]) / last;
  return {values[2] + last / (rate - 1), values[2] + last};
}

TEST(AxisymmetricSphere, AgreesWithQuadraticTetrahedra) {
  const double weight = 1200e-9 * modeling::Gravity::kStandard;
  const AxisymmetricSphere sphere(25, -20, {0.1, 0.45}, weight);
  const auto check = [](const char* name, double value, const std::array<double, 3>& others) {
    const auto [observed, first] = limits(others);
    std::printf("%s: axisymmetric %.6f, finest tetrahedra %+.1e, limits %+.1e and %+.1e\n", name,
                value, others[2] / value - 1, observed / value - 1, first / value - 1);
    EXPECT_GT(std::abs(value), std::abs(others[2])) << "all err from below";
    EXPECT_NEAR(observed, value, 4e-3 * std::abs(value));
    EXPECT_NEAR(first, value, 1.5e-3 * std::abs(value));
  };
  for (const Places& place : kTetrahedra) {
    double angle = place.angle;
    const double uz = sphere.surfaceDisplacement(angle)[1];
    EXPECT_NEAR(angle, place.angle, 1e-9);
    check("u_z", uz, place.uz);
  }
  check("energy", sphere.energy(), kEnergy);
  // On its own finer and finer meshes.
  const AxisymmetricSphere coarser(25, -20, {0.1, 0.45}, weight, 18);
  EXPECT_NEAR(coarser.energy(), sphere.energy(), 1.5e-4 * sphere.energy());
}

}  // namespace
}  // namespace palpa::app::test

#include <gtest/gtest.h>

#include <fstream>

#include "analytic_case.h"

namespace palpa::bem {
namespace {

using nlohmann::json;
using test::AnalyticCase;

/// Families of cases and the errors allowed with about 500 nodes (elements of 4 to 5 mm), about
/// twice what was measured when the tests were written. Flat elements lose 1 - cos(h / 2R), 0.5 %
/// of the radius, and the linear fields on them are good to the square of the mesh size; nodes on a
/// box are exact for linear fields. Where a pressure of the size of the load meets a nearly
/// incompressible body that hardly moves, the same error is divided by a smaller displacement.
struct Family {
  const char* prefix;
  double displacement, points, traction;
  double resultant = 0;
};
constexpr Family kFamilies[] = {
    {"sphere_pressure_nu", 0.02, 0.06, 0.06},
    {"hollow_sphere_internal_pressure_nu0.30", 0.12, 0.10, 0.10},
    {"hollow_sphere_internal_pressure_nu0.45", 0.30, 0.30, 0.18},
    {"hollow_cylinder_plane_strain_nu0.30", 0.035, 0.04, 0.3},
    {"hollow_cylinder_plane_strain_nu0.45", 0.08, 0.08, 0.6},
    {"hollow_cylinder_plane_strain_nu0.50", 0.18, 0.2, 1.3},
    // The area of the 28-gon is 0.84 % below that of the circle, its polar moment 1.7 %.
    {"cylinder_tension_nu", 1e-10, 2e-3, 1e-9, 0.01},
    {"cylinder_torsion_traction_nu", 3e-3, 7e-3, 0.15, 0.025},
    {"cylinder_torsion_displacement_nu", 2e-4, 7e-3, 0.15, 0.025},
    {"cylinder_flexure_nu", 0.025, 0.02, 0.18, 0.03},
    {"patch_linear_sphere_nu", 0.015, 0.04, 0.06},
    {"patch_linear_cylinder_nu", 0.025, 0.035, 0.05},
    {"patch_linear_box_nu", 1e-9, 1e-9, 1e-8},
    {"patch_linear_torus_nu", 0.05, 0.08, 0.25},
    {"incompressible_hydro_dev_sphere_nu", 3e-3, 0.015, 0.06},
    {"hydro_dev_sphere_nu", 3e-3, 0.015, 0.06},
    {"incompressible_hydro_dev_cylinder_nu", 7e-3, 0.012, 0.04},
    {"hydro_dev_cylinder_nu", 7e-3, 0.012, 0.04},
    {"incompressible_hydro_dev_box_nu", 1e-9, 1e-9, 1e-8},
    {"hydro_dev_box_nu", 1e-9, 1e-9, 1e-8},
    {"incompressible_hydro_dev_torus_nu", 0.01, 0.02, 0.12},
    {"hydro_dev_torus_nu", 0.01, 0.02, 0.12},
    {"kelvin_exterior_sphere_nu", 0.01, 0.01, 0.1},
    {"kelvin_exterior_cylinder_nu", 0.06, 0.08, 0.09},
    {"kelvin_exterior_box_nu", 5e-3, 0.01, 0.015},
    {"kelvin_exterior_torus_nu", 5e-3, 0.01, 0.12},
    {"sphere_P2_radial_nu", 0.02, 0.025, 0.08},
};

constexpr const char* kNotCovered[] = {
    // Half-spaces need a body many times larger than its load, graded towards it, whose own error
    // falls only like load over body; Hertz's laws need a contact search. Both come with the issue
    // on contact between bodies.
    "halfspace_",
    "hertz_",
    // At nu = 0.5 the boundary integral equation is blind to a uniform pressure in a closed cavity:
    // with n the normal of the cavity's surface alone, ∫ U n = 0 and ∫ n T = 0, so the system is
    // singular but for discretisation errors. Measured errors of u: 44 % at nu = 0.49, 89 % at 0.5,
    // the latter the same on finer meshes.
    "hollow_sphere_internal_pressure_nu0.49",
    "hollow_sphere_internal_pressure_nu0.50",
};

const json& cases() {
  static const json loaded = [] {
    std::ifstream file("data/analytic.json");
    return file ? json::parse(file)["cases"] : json::array();
  }();
  return loaded;
}

bool startsWith(const json& item, const char* prefix) {
  return item["id"].get<std::string>().starts_with(prefix);
}

TEST(AnalyticCases, EveryCaseIsCoveredOrSaysWhyNot) {
  ASSERT_GE(cases().size(), 79u) << "the working directory must be tests/";
  for (const json& item : cases()) {
    int covered = 0;
    for (const Family& family : kFamilies) covered += startsWith(item, family.prefix);
    for (const char* prefix : kNotCovered) covered += startsWith(item, prefix);
    EXPECT_EQ(covered, 1) << item["id"];
  }
}

class AnalyticFamily : public ::testing::TestWithParam<Family> {};

TEST_P(AnalyticFamily, IsReproduced) {
  const Family& family = GetParam();
  int solved = 0;
  for (const json& item : cases()) {
    if (!startsWith(item, family.prefix)) continue;
    const AnalyticCase body(item);
    const std::string id = item["id"];
    SCOPED_TRACE(id);
    // Differences of order 4 with a step of 0.05 mm; near nu = 0.5 Hooke's law magnifies their
    // rounding.
    EXPECT_LE(body.inconsistency(), 1e-6);
    for (const auto data : {AnalyticCase::Data::kAsStated, AnalyticCase::Data::kMixed}) {
      const bool mixed = data == AnalyticCase::Data::kMixed;
      if (mixed && !body.anyMixture()) continue;
      if (!mixed && item["material"]["nu"] == 0.5 && item["bc"].size() == 1 &&
          item["bc"][0]["type"] == "displacement")
        continue;  // displacement everywhere leaves the pressure open: see Solvability
      const auto errors = body.solve(data);
      std::printf("%-42s %-6s n %4d  u %.1e  points %.1e  p %.1e  reaction %.1e\n", id.c_str(),
                  mixed ? "mixed" : "stated", errors.nodes, errors.displacement, errors.points,
                  errors.traction, errors.resultant);
      EXPECT_LE(errors.displacement, family.displacement) << (mixed ? "mixed" : "as stated");
      EXPECT_LE(errors.points, family.points) << (mixed ? "mixed" : "as stated");
      EXPECT_LE(errors.traction, family.traction) << (mixed ? "mixed" : "as stated");
      EXPECT_LE(errors.resultant, family.resultant) << (mixed ? "mixed" : "as stated");
      ++solved;
    }
  }
  EXPECT_GT(solved, 0);
}

INSTANTIATE_TEST_SUITE_P(Cases, AnalyticFamily, ::testing::ValuesIn(kFamilies),
                         [](const auto& family) {
                           std::string name = family.param.prefix;
                           std::erase_if(name, [](char c) { return c == '_' || c == '.'; });
                           return name;
                         });

}  // namespace
}  // namespace palpa::bem

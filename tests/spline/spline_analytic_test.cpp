// The exact solutions of data/analytic.json on bodies of splines: the body is held by the exact
// displacement on a part of its surface, and has the exact tractions on the rest.

#include <fstream>

#include "analytic_case.h"
#include "bem/spline/spline_results.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Families of cases, as those of triangles (tests/bem/analytic_test.cpp), and the largest error of
/// u allowed at the points of the file, over the largest displacement there; about twice what was
/// measured. Integrals are good to 1e-5, which is what is left of linear fields on a box (closed
/// forms make triangles exact there). Hollow bodies are missing.
struct Family {
  const char* prefix;
  double points;
};
constexpr Family kFamilies[] = {
    {"sphere_pressure_nu", 2e-4},
    {"cylinder_tension_nu", 2e-5},
    {"cylinder_torsion_traction_nu", 3e-5},
    {"cylinder_torsion_displacement_nu", 3e-5},
    {"cylinder_flexure_nu", 3e-5},
    {"patch_linear_sphere_nu", 2e-4},
    {"patch_linear_cylinder_nu", 1e-4},
    {"patch_linear_box_nu", 3e-5},
    {"patch_linear_torus_nu", 3e-4},
    {"incompressible_hydro_dev_sphere_nu", 5e-5},
    {"hydro_dev_sphere_nu", 5e-5},
    {"incompressible_hydro_dev_cylinder_nu", 3e-5},
    {"hydro_dev_cylinder_nu", 3e-5},
    {"incompressible_hydro_dev_box_nu", 3e-5},
    {"hydro_dev_box_nu", 3e-5},
    {"incompressible_hydro_dev_torus_nu", 1.5e-4},
    {"hydro_dev_torus_nu", 1.5e-4},
    {"kelvin_exterior_sphere_nu", 1.6e-3},
    {"kelvin_exterior_cylinder_nu", 0.02},
    {"kelvin_exterior_box_nu", 0.01},
    {"kelvin_exterior_torus_nu", 1e-3},
    {"sphere_P2_radial_nu", 1.5e-3},
};

const json& cases() {
  static const json loaded = [] {
    std::ifstream file("data/analytic.json");
    return file ? json::parse(file)["cases"] : json::array();
  }();
  return loaded;
}

Vector3d vectorOf(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

/// The body of a case with about 400 coefficients, held where the tag is 1.
SplineSurface surfaceOf(const json& geometry) {
  const std::string type = geometry["type"];
  const auto base = [](const Vector3d& x) { return x.z() < 1e-6; };
  if (type == "sphere")
    return heldWhere(app::splineSurfaceOf(modeling::makeSphere(geometry["R"], 9)), isBelow);
  if (type == "cylinder")
    return heldWhere(
        app::splineSurfaceOf(halved(modeling::makeCylinder(geometry["R"], geometry["H"]))), base);
  if (type == "torus")
    return heldWhere(app::splineSurfaceOf(makeTorus(geometry["R_major"], geometry["r_minor"])),
                     [](const Vector3d& x) { return x.z() < -7; });
  const Vector3d size = vectorOf(geometry["max"]) - vectorOf(geometry["min"]);
  return heldWhere(app::splineSurfaceOf(halved(halved(modeling::makeBox(size)))), base);
}

/// A body under pressure that is incompressible does not move at all: its error is compared with a
/// twentieth of what the load would do to a rod of its size.
double pointError(const json& item, const SplineBody& body, const ExactField& exact) {
  const SplineResults results(body.surface, body.tractions);
  double error = 0, moved = 0, stress = 0, size = 0;
  for (const json& point : item["points"]) {
    const Vector3d x = vectorOf(point["x"]), expected = vectorOf(point["u"]);
    Vector3d found = Vector3d::Constant(INFINITY);
    if (point["region"] != "interior") {
      found = body.displacement(nearestPlace(body.surface, x));
    } else if (const auto state = results.interiorState(body.field.u.col(0), body.field.p.col(0),
                                                        body.material, x)) {
      found = state->displacement;
    }
    error = std::max(error, (found - expected).norm());
    moved = std::max(moved, expected.norm());
    stress = std::max(stress, exact.stress(x).norm());
    size = std::max(size, 2 * x.norm());
  }
  return error / std::max(moved, 0.05 * stress / body.material.youngsModulus * size);
}

class SplineAnalyticFamily : public ::testing::TestWithParam<Family> {};

TEST_P(SplineAnalyticFamily, IsReproduced) {
  std::vector<const json*> family;
  for (const json& item : cases())
    if (item["id"].get<std::string>().starts_with(GetParam().prefix)) family.push_back(&item);
  ASSERT_FALSE(family.empty()) << "the working directory must be tests/";
  // Every other material, the least compressible among them.
  for (std::size_t k = (family.size() - 1) % 2; k < family.size(); k += 2) {
    const json& item = *family[k];
    const std::string id = item["id"];
    SCOPED_TRACE(id);
    const AnalyticCase known(item);
    const ExactField exact = known.exactField();
    const SplineBody body(surfaceOf(item["geometry"]),
                          {item["material"]["E"], item["material"]["nu"]}, exact, {1e-5});
    const double error = pointError(item, body, exact);
    std::printf("%-42s n %4d  points %.1e\n", id.c_str(), body.surface.coefficientCount(), error);
    EXPECT_LE(error, GetParam().points);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, SplineAnalyticFamily, ::testing::ValuesIn(kFamilies),
                         [](const auto& family) {
                           std::string name = family.param.prefix;
                           std::erase_if(name, [](char c) { return c == '_' || c == '.'; });
                           return name;
                         });

}  // namespace
}  // namespace palpa::bem::test

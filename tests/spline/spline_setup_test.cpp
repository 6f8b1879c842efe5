// From projects to the spline discretisation: the parts of supports and loads, and what is refused.
#include "app/core/setup/spline_setup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>

#include "app/core/setup/boundary_setup.h"
#include "bem/base/error.h"
#include "bem/spline/spline_projection.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/project_file.h"
#include "modeling/solid/surface_evaluator.h"
#include "solved_setup.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Project;
using modeling::Region;
using modeling::Support;

constexpr double kFingertip = 6.0;  // mm

std::vector<int> elementsOf(const bem::SplineSurface& surface) {
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  return all;
}

double areaOf(const bem::SplineSurface& surface, const std::vector<int>& elements) {
  double area = 0;
  bem::visitSplinePoints(surface, elements, 6, INFINITY,
                         [&](const auto&, const auto&, double weight) { area += weight; });
  return area;
}

/// Every example with a solid, with loads of each kind whose borders cut elements: parts have the
/// areas and resultants that fine triangles give them.
TEST(SplineSetup, ExamplesHaveThePartsThatTrianglesHave) {
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator("../projects")) {
    if (entry.path().extension() != ".json") continue;
    Project project = modeling::readProject(entry.path());
    const auto* solid = std::get_if<modeling::Solid>(&project.body);
    if (!solid) continue;
    ++examples;
    const auto [low, high] = modeling::boundingBox(project.body);
    const Vector3d size = high - low;
    const double radius = size.norm() / 16;
    const Vector3d summit =
        modeling::SurfaceEvaluator(*solid).position(solid->findPatch("top").value_or(4), 0.5, 0.5);
    Region mixed = Region::ofPatches({solid->patches()[0].name});
    mixed.parts.emplace_back(modeling::HalfSpace{{0, -3, 0}, -3 * (low.y() + 0.7 * size.y())});
    Region painted{{modeling::Stroke{{summit}, radius}}};
    project.loads = {{"lean", modeling::UniformTraction{mixed, {0.01, 0, 0.02}}},
                     {"blow", modeling::Pressure{painted, 0.03}},
                     {"poke", modeling::Bump{summit, radius, 0.01, {0, 0, -1}}}};
    project.mesh.engine = modeling::Engine::kSplines;
    project.mesh.patchFactors.clear();
    project.mesh.refinementLevels = 0;
    project.mesh.edgeLength = size.norm() / 50;
    const auto mesh = modeling::mesh(project.body, project.mesh, modeling::meshRegions(project));
    const SplineRefinement net = splineRefinement(project, modeling::SurfaceEvaluator(*solid),
                                                  ElementSizes::of(project.mesh, kFingertip));
    const BoundarySetup setup = makeBoundarySetup(ProjectGeometry(project, net), mesh);
    const bem::SplineSurface& surface = setup.splines->surface();
    project.mesh.engine = modeling::Engine::kTriangles;
    const BoundarySetup triangles = makeBoundarySetup(ProjectGeometry(project), mesh);
    std::printf("%s: n %d of %.0f foreseen, %d elements, %d slots, %.2f mm\n",
                entry.path().stem().c_str(), surface.coefficientCount(), net.coefficients,
                surface.elementCount(), setup.discretisation->slots().count(), net.interior);
    EXPECT_NEAR(surface.coefficientCount(), net.coefficients, 0.05 * net.coefficients);
    EXPECT_LE(surface.coefficientCount(),
              1.05 * 1.4 * ElementSizes::of(project.mesh, kFingertip).budget);
    // Flat triangles lose some of the area of curved faces, and of painted discs, of which they
    // make polygons with some twelve corners.
    const auto tolerance = [](const std::string& name) { return name == "blow" ? 0.03 : 0.01; };
    const auto triangleArea = [&](const std::vector<int>& list) {
      double area = 0;
      for (const int t : list)
        area += 0.5 * (mesh.positions[mesh.triangles[t][1]] - mesh.positions[mesh.triangles[t][0]])
                          .cross(mesh.positions[mesh.triangles[t][2]] -
                                 mesh.positions[mesh.triangles[t][0]])
                          .norm();
      return area;
    };
    const auto expectArea = [&](const std::vector<int>& elements, int region,
                                const std::string& name) {
      const double area = triangleArea(mesh.trianglesOfRegion[region]);
      EXPECT_NEAR(areaOf(surface, elements), area, tolerance(name) * area) << entry.path() << name;
    };
    int region = 0;
    for (const auto& support : setup.supports) expectArea(support.elements, region++, support.name);
    for (std::size_t k = 0; k < project.loads.size(); ++k) {
      const auto& load = setup.loads[k];
      const bem::Resultant& expected = triangles.loads[k].resultant;
      const double force = expected.force.norm();
      EXPECT_LT((load.resultant.force - expected.force).norm(), tolerance(load.name) * force)
          << entry.path() << load.name;
      EXPECT_LT((load.resultant.moment - expected.moment).norm(),
                tolerance(load.name) * force * size.norm())
          << entry.path() << load.name;
    }
    if (entry.path().stem() == "box") {
      EXPECT_NEAR(setup.loads[1].resultant.force.norm() / 0.03, std::numbers::pi * radius * radius,
                  1e-3 * radius * radius)
          << "a disc of the flat top";
    }
    // Equal tags are equal parts.
    std::map<int, double> areaOfTag;
    for (int e = 0; e < surface.elementCount(); ++e)
      areaOfTag[surface.elements()[e].tag] += areaOf(surface, {e});
    std::map<int, std::vector<int>> trianglesOfTag;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      trianglesOfTag[setup.mesh().tags[t]].push_back(static_cast<int>(t));
    const double whole = areaOf(surface, elementsOf(surface));
    for (const auto& [tag, list] : trianglesOfTag)
      EXPECT_NEAR(areaOfTag[tag], triangleArea(list), 0.005 * whole) << entry.path() << tag;
  }
  EXPECT_EQ(examples, 8);
}

std::string faultOf(const Project& project) {
  try {
    test::setupOf(project);
  } catch (const bem::SolverError& error) {
    return error.what();
  }
  return "";
}

TEST(SplineSetup, SupportsThatDisagreeAreNamed) {
  Project project = test::boxOfSplines();
  project.supports = {{"base", Support::Kind::kFixed, Region::ofPatches({"bottom"}), {0, 0, 0}},
                      {"foot", Support::Kind::kFixed, Region::below({0, 0, 1}, 5), {0, 0, 0}}};
  EXPECT_EQ(faultOf(project), "");  // they agree
  project.supports[1].displacement = {0, 0, 1};
  EXPECT_EQ(faultOf(project).find("supports \"base\" and \"foot\" overlap near"), 0U);
  project.supports[1] = {
      "side", Support::Kind::kFixed, Region::ofPatches({"side_xmin"}), {1, 0, 0}};
  EXPECT_EQ(faultOf(project).find("supports \"base\" and \"side\" meet at"), 0U);
  project.supports[1].displacement.setZero();
  EXPECT_EQ(faultOf(project), "");
}

}  // namespace
}  // namespace palpa::app

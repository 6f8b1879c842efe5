// The analysis net: which knots are inserted for the spline discretisation.
#include "app/core/setup/spline_refinement.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <limits>

#include "app/core/setup/boundary_setup.h"
#include "bem/spline/spline_mask_widths.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "modeling/solid/surface_properties.h"
#include "spline_body.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Project;
using modeling::Region;
using modeling::Support;

Project projectOf(modeling::Solid solid) {
  Project project;
  project.material = {"", 0.1, 0.45};
  project.body = std::move(solid);
  project.supports = {{"base", Support::Kind::kFixed, Region::ofPatches({"bottom"}), {0, 0, 0}}};
  return project;
}

SplineRefinement netOf(const Project& project) {
  return splineRefinement(project,
                          modeling::SurfaceEvaluator(std::get<modeling::Solid>(project.body)),
                          ElementSizes::of(project.mesh, 6));
}

const modeling::Solid& solidOf(const Project& project) {
  return std::get<modeling::Solid>(project.body);
}

const SplineRefinement::Chain& chainWith(const SplineRefinement& net, const modeling::Solid& solid,
                                         const char* patch, int direction) {
  for (const SplineRefinement::Chain& chain : net.chains)
    for (const modeling::ChainLink& link : modeling::chainOf(solid, chain.first))
      if (link.at.patch == *solid.findPatch(patch) && link.at.direction == direction) return chain;
  throw std::logic_error("no chain");
}

TEST(SplineRefinement, IsTheSameSurfaceWithTheCoefficientsForeseen) {
  for (const Project& project :
       {projectOf(modeling::makeBox({40, 30, 20})), projectOf(modeling::makeCylinder(20, 60)),
        projectOf(modeling::makeSphere(25))}) {
    const auto start = std::chrono::steady_clock::now();
    const SplineRefinement net = netOf(project);
    const auto made = std::chrono::steady_clock::now();
    const modeling::Solid fine = refined(solidOf(project), net);
    const auto inserted = std::chrono::steady_clock::now();
    const auto milliseconds = [](auto a, auto b) {
      return std::chrono::duration<double, std::milli>(b - a).count();
    };
    std::printf("%zu points to %zu: net %.1f ms, insertion %.1f ms\n",
                solidOf(project).controlPoints().size(), fine.controlPoints().size(),
                milliseconds(start, made), milliseconds(made, inserted));
    EXPECT_EQ(static_cast<double>(fine.controlPoints().size()), net.coefficients);
    EXPECT_LT(modeling::sampledDistance(solidOf(project), fine), 1e-11);
  }
}

TEST(SplineRefinement, RaisesLowDegreesToThree) {
  Project project;
  project.body = modeling::makeBox({40, 30, 20});
  // A box with degree 1: eight points.
  std::vector<modeling::Patch> patches = solidOf(project).patches();
  for (modeling::Patch& patch : patches) {
    patch.degree = {1, 1};
    for (auto& knots : patch.knots) knots = {0, 0, 1, 1};
    const auto& net = patch.net;
    patch.net = {{net[0][0], net[0].back()}, {net.back()[0], net.back().back()}};
  }
  std::vector<int> used;
  for (modeling::Patch& patch : patches)
    for (auto& row : patch.net)
      for (int& point : row) used.push_back(point);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Vector3d> points;
  for (const int point : used) points.push_back(solidOf(project).controlPoints()[point]);
  for (modeling::Patch& patch : patches)
    for (auto& row : patch.net)
      for (int& point : row)
        point = static_cast<int>(std::lower_bound(used.begin(), used.end(), point) - used.begin());
  project.body = modeling::Solid(points, patches);
  const SplineRefinement net = netOf(project);
  const modeling::Solid fine = refined(solidOf(project), net);
  EXPECT_EQ(fine.patches()[0].degree[0], 3);
  EXPECT_EQ(static_cast<double>(fine.controlPoints().size()), net.coefficients);
  EXPECT_LT(modeling::sampledDistance(solidOf(project), fine), 1e-11);
}

TEST(SplineRefinement, GradesTowardsTheEdgesOfSupports) {
  Project project = projectOf(modeling::makeBox({40, 30, 20}));
  project.mesh.elementLength = 5;
  project.mesh.accuracy = 3e-3;
  const auto gaps = [&](const char* patch, int direction) {
    const SplineRefinement net = netOf(project);
    std::vector<double> knots = chainWith(net, solidOf(project), patch, direction).knots;
    knots.insert(knots.begin(), 0.0);
    knots.push_back(1.0);
    std::vector<double> result;
    for (std::size_t k = 1; k < knots.size(); ++k) result.push_back(knots[k] - knots[k - 1]);
    return result;
  };
  // The base is fixed: both directions of its patch are graded at both ends, evenly in between.
  const std::vector<double> across = gaps("bottom", 0);
  EXPECT_LT(across.front(), 0.6 * across[across.size() / 2]);
  EXPECT_NEAR(across.front(), across.back(), 1e-12);
  for (std::size_t k = 1; k < across.size(); ++k)
    EXPECT_LT(std::max(across[k] / across[k - 1], across[k - 1] / across[k]), 2.6);
  project.mesh.accuracy = 1e-3;
  EXPECT_LT(gaps("bottom", 0).front(), 0.7 * across.front());
  // For one per cent the free side is enough.
  project.mesh.accuracy = 1e-2;
  const auto isEven = [](const std::vector<double>& sizes) {
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    return *most - *least < 1e-12;
  };
  EXPECT_TRUE(isEven(gaps("bottom", 0)));
  EXPECT_FALSE(isEven(gaps("side_xmax", 1)));
  project.supports.clear();
  EXPECT_TRUE(isEven(gaps("side_xmax", 1)));
}

TEST(SplineRefinement, GivesTouchesTheMasksTheyAskFor) {
  for (const auto& entry : std::filesystem::directory_iterator("../projects")) {
    if (entry.path().extension() != ".json") continue;
    const Project project = modeling::readProject(entry.path());
    if (!std::holds_alternative<modeling::Solid>(project.body)) continue;
    const SplineRefinement net =
        splineRefinement(project, modeling::SurfaceEvaluator(solidOf(project)),
                         ElementSizes::of(project.mesh, fingertipRadius(project)));
    const bem::SplineSurface surface = splineSurfaceOf(refined(solidOf(project), net));
    const bem::SplineMaskWidths widths(surface);
    EXPECT_LE(net.coefficients, 1750) << entry.path();
    for (const modeling::Touch& touch : project.touches) {
      if (touch.kind == modeling::TouchKind::kBall) continue;
      const bem::ElementPlace place = bem::test::nearestPlace(surface, touch.at);
      const double mask = widths.at(place.element, surface.evaluate(place).position);
      std::printf("%s, n %.0f, %s: mask %.2f for %.2f mm\n", project.name.c_str(), net.coefficients,
                  touch.name.c_str(), mask, *touch.radius);
      EXPECT_LE(mask, 1.03 * *touch.radius) << entry.path() << touch.name;
    }
  }
}

/// Only around it: the same everywhere costs a multiple.
TEST(SplineRefinement, RefinesAroundANarrowTouchAlone) {
  Project project = projectOf(modeling::makeBox({40, 30, 20}));
  const double plain = ProjectGeometry(project).refinement().coefficients;
  project.touches = {{"poke", {5, 4, 20}, modeling::TouchKind::kGrab, {0, 0, -1}, 2.0}};
  const double poked = ProjectGeometry(project).refinement().coefficients;
  EXPECT_GT(poked, 1.1 * plain);
  ElementSizes everywhere = ElementSizes::of(project.mesh, 2);
  everywhere.budget = std::numeric_limits<double>::infinity();
  EXPECT_LT(poked, 0.4 * splineRefinement(project, modeling::SurfaceEvaluator(solidOf(project)),
                                          everywhere)
                             .coefficients);
}

TEST(SplineRefinement, PutsSmallElementsAcrossBordersAndUnderBumps) {
  Project project = projectOf(modeling::makeBox({40, 30, 20}));
  project.mesh.elementLength = 5;
  project.supports.clear();
  const double plain = netOf(project).coefficients;
  project.supports = {
      {"dab", Support::Kind::kFixed, Region{{modeling::Stroke{{{20, 15, 20}}, 2.0}}}, {0, 0, 0}}};
  const auto [low, high] = modeling::boundingBox(project.body);
  std::get<modeling::Stroke>(project.supports[0].where.parts[0]).points[0] =
      Vector3d((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, high.z());
  const SplineRefinement dab = netOf(project);
  EXPECT_GT(dab.coefficients, plain + 50);
  const auto& knots = chainWith(dab, solidOf(project), "top", 0).knots;
  double least = 1;
  for (std::size_t k = 1; k < knots.size(); ++k) least = std::min(least, knots[k] - knots[k - 1]);
  EXPECT_LE(least * 40, 2.0);
  project.supports.clear();
  project.loads = {
      {"poke", modeling::Bump{{(low + high) / 2 + Vector3d(0, 0, 10)}, 3, 1, {0, 0, -1}}}};
  EXPECT_GT(netOf(project).coefficients, plain + 50);
}

TEST(SplineRefinement, FollowsTheWishFactorsAndTheBudget) {
  Project project = projectOf(modeling::makeCylinder(20, 60));
  std::vector<double> counts;
  for (const double accuracy : {3e-2, 1e-2, 3e-3, 1e-3}) {
    project.mesh.accuracy = accuracy;
    const ElementSizes sizes = ElementSizes::of(project.mesh, 6);
    counts.push_back(splineRefinement(project, modeling::SurfaceEvaluator(solidOf(project)), sizes)
                         .coefficients);
    EXPECT_LE(counts.back(), sizes.budget);
    if (counts.size() > 1) {
      EXPECT_GT(counts.back(), 1.1 * counts[counts.size() - 2]);
    }
  }
  project.mesh.elementLength = 4;
  const SplineRefinement even = netOf(project);
  EXPECT_EQ(even.interior, 4);
  project.mesh.patchFactors = {{"side_xmax", 0.5}};
  EXPECT_GT(netOf(project).coefficients, 1.2 * even.coefficients);
  project.mesh.patchFactors.clear();
  project.mesh.elementLength = 1e-4;
  EXPECT_THROW(netOf(project), modeling::ModelingError);
}

/// Moving a control point a little leaves the knots as they are.
TEST(SplineRefinement, StaysWhenAControlPointMovesALittle) {
  Project project = projectOf(modeling::makeSphere(25));
  project.supports = {{"base", Support::Kind::kFixed, Region::below({0, 0, 1}, -20), {0, 0, 0}}};
  const SplineRefinement before = netOf(project);
  std::vector<Vector3d> points = solidOf(project).controlPoints();
  points[points.size() / 2] *= 1.002;
  project.body = solidOf(project).withControlPoints(points);
  const SplineRefinement after = netOf(project);
  ASSERT_EQ(after.chains.size(), before.chains.size());
  for (std::size_t c = 0; c < before.chains.size(); ++c)
    EXPECT_EQ(after.chains[c].knots, before.chains[c].knots);
}

}  // namespace
}  // namespace palpa::app

// Two variants of a project under the same touches.
#include "app/core/results/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/surface_correspondence.h"
#include "app/core/results/touch.h"
#include "base/job.h"
#include "bem/base/error.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Touch;
using modeling::TouchKind;
using Part = ComparisonRow::Part;

constexpr double kEdge = 6;  // mm

/// The clamped sphere, `scale` times as large in all lengths, Young's modulus times `stiffer`.
modeling::Project sphere(double scale = 1, double stiffer = 1) {
  modeling::Project project = test::clampedSphere(kEdge * scale);
  if (scale != 1) {
    auto& solid = std::get<modeling::Solid>(project.body);
    std::vector<Vector3d> points = solid.controlPoints();
    for (Vector3d& point : points) point *= scale;
    solid = solid.withControlPoints(points);
  }
  project.material.youngsModulus *= stiffer;
  return project;
}

VariantPlayer player(const std::string& name, const modeling::Project& project) {
  return VariantPlayer({name, buildTouchModel(project, {}, {}), project.material.densityKgPerM3});
}

const ComparisonRow& find(const std::vector<ComparisonRow>& rows, Part part,
                          ComparedFigure figure) {
  for (const ComparisonRow& row : rows)
    if (row.part == part && row.figure == figure) return row;
  throw std::runtime_error("no such row");
}

TEST(Comparison, OfABodyWithItselfHasNoDifference) {
  VariantPlayer a = player("a", sphere()), b = player("b", sphere());
  const std::vector<Touch> touches{{"ball", {0, 0, 25}, TouchKind::kBall, {0, 0, -2}, 8.0, 0.2},
                                   {"grab", {25, 0, 0}, TouchKind::kGrab, {1, 0, 0}, {}}};
  Comparison comparison = compareVariants(a, b, touches, {});
  ASSERT_EQ(comparison.carried.size(), 2u);
  // A touch without a radius has the same one on both.
  EXPECT_EQ(comparison.touches[1].radius, comparison.carried[1].touch.radius);
  EXPECT_TRUE(comparison.touches[1].radius.has_value());
  estimateErrors(a, b, comparison, {});
  for (const ComparisonRow& row : comparison.rows()) {
    ASSERT_TRUE(row.difference()) << row.name;
    // The nearest surface point of B lies on the mesh, not exactly at the place typed for A.
    EXPECT_NEAR(*row.difference(), 0, 2e-2 * std::abs(*row.values[0]) + 1e-9)
        << infoOf(row.figure).name;
    if (row.part != Part::kBody) {
      EXPECT_TRUE(row.isWithinErrors()) << infoOf(row.figure).name;
    }
  }
}

// Linear elasticity: with prescribed displacements forces and stresses are in proportion to E, and
// displacements do not depend on it; with given forces it is the other way round.
TEST(Comparison, FollowsYoungsModulus) {
  VariantPlayer a = player("a", sphere()), b = player("b", sphere(1, 2));
  const std::vector<Touch> grab{{"grab", {0, 0, 25}, TouchKind::kGrab, {0.5, 0, -2}, 8.0}};
  const auto rows = compareVariants(a, b, grab, {}).rows();
  using enum ComparedFigure;
  const double exact = 1e-6;
  EXPECT_NEAR(*find(rows, Part::kContact, kForce).relativeDifference(), 1, exact);
  EXPECT_NEAR(*find(rows, Part::kContact, kStiffness).relativeDifference(), 1, exact);
  EXPECT_NEAR(*find(rows, Part::kContact, kMoved).relativeDifference(), 0, exact);
  EXPECT_NEAR(*find(rows, Part::kBody, kMaxDisplacement).relativeDifference(), 0, exact);
  EXPECT_NEAR(*find(rows, Part::kBody, kMaxStress).relativeDifference(), 1, exact);
  EXPECT_NEAR(*find(rows, Part::kBody, kEnergy).relativeDifference(), 1, exact);
  EXPECT_NEAR(*find(rows, Part::kSupport, kReaction).relativeDifference(), 1, 1e-3);
  EXPECT_EQ(*find(rows, Part::kBody, kVolume).difference(), 0);
  const std::vector<Touch> pull{{"pull", {0, 0, 25}, TouchKind::kForce, {0, 0, -1}, 8.0}};
  const auto pulled = compareVariants(a, b, pull, {}).rows();
  EXPECT_NEAR(*find(pulled, Part::kContact, kForce).relativeDifference(), 0, exact);
  EXPECT_NEAR(*find(pulled, Part::kContact, kMoved).relativeDifference(), -0.5, exact);
}

TEST(Comparison, CarriesPlacesToTheNearestPoint) {
  VariantPlayer a = player("a", sphere()), b = player("b", sphere(1.04));
  const std::vector<Touch> touches{{"ball", {0, 0, 25}, TouchKind::kBall, {0, 0, -1}, 6.0}};
  const Comparison comparison = compareVariants(a, b, touches, {});
  // 25 mm to 26 mm; the mesh lies up to a percent of the radius inside the sphere.
  EXPECT_NEAR(comparison.carried[0].distance, 1, 0.25);
  EXPECT_NEAR(comparison.carried[0].touch.at.norm(), 26, 0.25);
  EXPECT_FALSE(comparison.carried[0].isTurned);
  EXPECT_EQ(comparison.carried[0].touch.vector, touches[0].vector);
  const auto rows = comparison.rows();
  EXPECT_NEAR(1 + *find(rows, Part::kBody, ComparedFigure::kVolume).relativeDifference(),
              std::pow(1.04, 3), 1e-6);
  EXPECT_GT(*find(rows, Part::kContact, ComparedFigure::kForce).values[1], 0);
}

TEST(Comparison, MassNeedsADensity) {
  modeling::Project dense = sphere();
  dense.material.densityKgPerM3 = 1000;
  modeling::Project unknown = sphere();
  unknown.material.densityKgPerM3.reset();
  VariantPlayer a = player("a", dense), b = player("b", unknown);
  const auto rows = compareVariants(a, b, {}, {}).rows();
  const ComparisonRow& mass = find(rows, Part::kBody, ComparedFigure::kMass);
  // Water: a gram per cm^3; the volume of the sphere is 4/3 pi 2.5^3 cm^3.
  EXPECT_NEAR(mass.values[0].value(), 4.0 / 3 * std::numbers::pi * 15.625, 0.05);
  EXPECT_FALSE(mass.values[1] || mass.difference() || mass.relativeDifference());
  EXPECT_TRUE(find(rows, Part::kBody, ComparedFigure::kVolume).difference());
}

TEST(Comparison, SupportsArePairedByName) {
  modeling::Project other = sphere();
  other.supports[0].name = "foot";
  VariantPlayer a = player("a", sphere()), b = player("b", other);
  int onlyA = 0, onlyB = 0;
  for (const ComparisonRow& row : compareVariants(a, b, {}, {}).rows())
    if (row.part == Part::kSupport) {
      onlyA += row.values[0] && !row.values[1];
      onlyB += row.values[1] && !row.values[0];
      EXPECT_FALSE(row.difference());
    }
  EXPECT_EQ(onlyA, 1);
  EXPECT_EQ(onlyB, 1);
}

TEST(Comparison, NamesTheVariantThatCannotBeTouched) {
  // The whole of B is fixed at the touched place.
  VariantPlayer a = player("first", sphere()), b = player("second", sphere());
  const std::vector<Touch> bottom{{"grab", {0, 0, -25}, TouchKind::kGrab, {0, 0, 1}, 2.0}};
  try {
    compareVariants(a, b, bottom, {});
    FAIL() << "on a support";
  } catch (const bem::SolverError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("first: ", 0), 0u) << error.what();
  }
  std::stop_source stop;
  stop.request_stop();
  Job job;
  job.stop = stop.get_token();
  const std::vector<Touch> ball{{"ball", {0, 0, 25}, TouchKind::kBall, {0, 0, -1}, 6.0}};
  EXPECT_THROW(compareVariants(a, b, ball, job), Cancelled);
}

TEST(Comparison, IsWrittenAsATable) {
  VariantPlayer a = player("a", sphere()), b = player("b", sphere(1, 2));
  const std::vector<Touch> grab{{"pull, \"hard\"", {0, 0, 25}, TouchKind::kGrab, {0, 0, 1}, 8.0}};
  Comparison comparison = compareVariants(a, b, grab, {});
  const auto rows = comparison.rows();
  std::ostringstream out;
  writeComparison(rows, out);
  const std::string text = out.str();
  EXPECT_EQ(text.rfind("part,name,figure,a,b,difference,", 0), 0u);
  EXPECT_NE(text.find("\ncontact,\"pull, \"\"hard\"\"\",force_N,"), std::string::npos) << text;
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), rows.size() + 1);
}

// A contact of the touch loop, played again, has the force of the loop.
TEST(Comparison, LiveContactsBecomeTouches) {
  VariantPlayer a = player("a", sphere());
  const Touch ball{"ball", {0, 0, 25}, TouchKind::kBall, {0.3, 0, -1.5}, 6.0, 0.3};
  const Touch grab{"grab", {25, 0, 0}, TouchKind::kGrab, {0.5, 0, 0}, 8.0};
  const std::vector<Touch> touches{grab, ball};
  const TouchState state = a.play(touches, {}).state;
  const std::vector<LiveContact> live{
      {"grab", {bem::ContactTool::Kind::kGrab, 8.0, 0}, grab.at, grab.vector},
      {"ball", {bem::ContactTool::Kind::kBall, 6.0, 0.3}, ball.at, state.contacts[1].tool}};
  const std::vector<Touch> found = a.touchesOf(live, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_LT((found[0].vector - grab.vector).norm(), 1e-12);
  EXPECT_LT((found[1].vector - ball.vector).norm(), 1e-9);
  EXPECT_EQ(found[1].friction, 0.3);
  EXPECT_LT((a.play(found, {}).state.contacts[1].force - state.contacts[1].force).norm(),
            1e-3 * state.contacts[1].force.norm());
}

TEST(SurfaceCorrespondence, CarriesValuesToTheNearestPoint) {
  const auto draw = [](const modeling::Project& project) {
    return DrawnBody(buildTouchModel(project, {}, {}), {2, 2});
  };
  const DrawnBody small = draw(sphere()), large = draw(sphere(1.04));
  const SurfaceCorrespondence pairs(small, large);
  EXPECT_NEAR(pairs.share(), 1, 1e-12);
  EXPECT_NEAR(pairs.farthest(), 1, 0.1);
  // A linear function on concentric spheres: the partner is 1.04 times as far out.
  std::vector<double> ofLarge;
  for (const Vector3d& x : large.mesh().positions) ofLarge.push_back(x.x());
  const std::vector<double> carried = pairs.carried(ofLarge);
  ASSERT_EQ(carried.size(), small.mesh().positions.size());
  for (std::size_t k = 0; k < carried.size(); ++k)
    EXPECT_NEAR(carried[k], 1.04 * small.mesh().positions[k].x(), 0.15);
}

TEST(SurfaceCorrespondence, KeepsSidesOfSharpEdgesApart) {
  modeling::Project box = test::freeBox(8);
  box.supports.push_back({"base", modeling::Support::Kind::kFixed,
                          modeling::Region::below(Vector3d::UnitZ(), 1e-6), Vector3d::Zero()});
  const auto model = buildTouchModel(box, {}, {});
  const DrawnBody body(model, {2, 2});
  const SurfaceCorrespondence pairs(body, body);
  EXPECT_NEAR(pairs.share(), 1, 1e-12);
  // The number of the patch's normal direction jumps at every edge.
  std::vector<double> sides;
  for (const Vector3d& n : body.mesh().normals) sides.push_back(n.x() + 2 * n.y() + 4 * n.z());
  const std::vector<double> carried = pairs.carried(sides);
  for (std::size_t k = 0; k < carried.size(); ++k) EXPECT_NEAR(carried[k], sides[k], 1e-6);
}

TEST(SurfaceCorrespondence, FarPartsHaveNoPartner) {
  const DrawnBody small(buildTouchModel(sphere(), {}, {}), {1, 1}),
      large(buildTouchModel(sphere(2), {}, {}), {1, 1});
  const SurfaceCorrespondence pairs(small, large);
  EXPECT_EQ(pairs.share(), 0);
  const std::vector<double> zeros(large.mesh().positions.size(), 0.0);
  for (const double value : pairs.carried(zeros)) EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace palpa::app

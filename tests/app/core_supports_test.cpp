// Supports that share a part of the surface, with both engines and for mesh bodies.
#include <gtest/gtest.h>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "app/core/setup/support_conflict.h"
#include "core_projects.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Engine;
using modeling::Project;
using modeling::Region;
using modeling::Stroke;
using modeling::Support;

std::shared_ptr<const TouchModel> build(const Project& project) {
  return buildTouchModel(project, BuildOptions{}, Job{});
}

/// The sphere of R = 25 mm, fixed below z = -20 mm, for each way to compute it.
std::vector<std::pair<std::string, Project>> spheres() {
  std::vector<std::pair<std::string, Project>> result;
  for (const Engine engine : {Engine::kTriangles, Engine::kSplines}) {
    Project project = test::clampedSphere(6);
    project.mesh.engine = engine;
    result.emplace_back(engine == Engine::kSplines ? "splines" : "triangles", project);
  }
  Project imported = test::clampedSphere(6);
  const modeling::SurfaceMesh mesh = modeling::mesh(imported.body, imported.mesh);
  imported.body = modeling::MeshBody(
      {mesh.positions, mesh.triangles, std::vector<int>(mesh.triangles.size(), 0), {"face"}});
  result.emplace_back("mesh body", imported);
  return result;
}

/// A disc on the border of the lowest cap: about half of it is inside.
Stroke disc() {
  return {{{17, 0, -18.5}}, 8};
}

TouchState touched(const TouchModel& model) {
  return playTouches(model, std::vector{modeling::Touch{
                                "push", {0, 0, 25}, modeling::TouchKind::kGrab, {1, 0, -2}, 9.0}});
}

std::optional<SupportConflict> conflictOf(const Project& project) {
  try {
    build(project);
  } catch (const SupportConflictError& error) {
    EXPECT_EQ(error.kind(), bem::SolverError::Kind::kBadCondition);
    EXPECT_NE(std::string(error.what()).find(error.conflict().first), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(error.conflict().second), std::string::npos);
    return error.conflict();
  }
  return {};
}

TEST(Supports, OverlapWithTheSameDisplacementActsLikeOneSupport) {
  for (auto& [name, project] : spheres()) {
    Project united = project;
    united.supports[0].where.parts.emplace_back(disc());
    const TouchState one = touched(*build(united));
    project.supports.push_back({"hand", Support::Kind::kFixed, {{disc()}}, {0, 0, 0}});
    const TouchState two = touched(*build(project));
    const double force = one.contacts[0].force.norm();
    // The meshes differ a little.
    EXPECT_LE((two.contacts[0].force - one.contacts[0].force).norm(), 5e-3 * force) << name;
    ASSERT_EQ(two.supports.size(), 2U);
    const Vector3d sum = two.supports[0].resultant.force + two.supports[1].resultant.force;
    EXPECT_LE((sum - one.supports[0].resultant.force).norm(), 5e-3 * force) << name;
    EXPECT_LE((sum + two.contacts[0].force).norm(), 0.01 * force) << name;
    EXPECT_LE(two.relativeBalance, 0.01) << name;
    // The overlap belongs to the first of the list: without it, the disc has less to hold.
    std::swap(project.supports[0], project.supports[1]);
    const TouchState swapped = touched(*build(project));
    EXPECT_GT(swapped.supports[0].resultant.force.norm(),
              1.1 * two.supports[1].resultant.force.norm())
        << name;
    const Vector3d other =
        swapped.supports[0].resultant.force + swapped.supports[1].resultant.force;
    EXPECT_LE((other - sum).norm(), 0.01 * force) << name;
  }
}

TEST(Supports, ASupportInsideAnotherHasNoReaction) {
  for (auto& [name, project] : spheres()) {
    const TouchState alone = touched(*build(project));
    project.supports.push_back(
        {"dot", Support::Kind::kFixed, {{Stroke{{{0, 0, -25}}, 6}}}, Vector3d::Zero()});
    const TouchState both = touched(*build(project));
    EXPECT_EQ(both.supports[1].resultant.force.norm(), 0) << name;
    EXPECT_LE((both.supports[0].resultant.force - alone.supports[0].resultant.force).norm(),
              0.01 * alone.supports[0].resultant.force.norm())
        << name;
  }
}

TEST(Supports, AFixedSupportTakesTheOverlapWithARoller) {
  for (auto& [name, project] : spheres()) {
    const TouchState before = touched(*build(project));
    project.supports.insert(
        project.supports.begin(),
        {"rail", Support::Kind::kRoller, {{Stroke{{{0, 0, -25}}, 6}}}, Vector3d::Zero()});
    const TouchState after = touched(*build(project));
    EXPECT_EQ(after.supports[0].resultant.force.norm(), 0) << name;
    EXPECT_LE((after.contacts[0].force - before.contacts[0].force).norm(),
              0.01 * before.contacts[0].force.norm())
        << name;
    // It matters where the normal displacements differ.
    project.supports[0].displacement = {0, 0, 0.5};
    const auto conflict = conflictOf(project);
    ASSERT_TRUE(conflict) << name;
    EXPECT_EQ(conflict->first, "rail") << name;
  }
}

TEST(Supports, EitherSupportCanTakeAContradictingOverlap) {
  for (auto& [name, project] : spheres()) {
    project.supports.push_back({"hand", Support::Kind::kFixed, {{disc()}}, {0, 0, 0.5}});
    const auto conflict = conflictOf(project);
    ASSERT_TRUE(conflict) << name;
    EXPECT_EQ(conflict->first, "base");
    EXPECT_EQ(conflict->second, "hand");
    EXPECT_TRUE(conflict->overlaps);
    EXPECT_LT(conflict->at.z(), -20 + 0.5) << name;
    EXPECT_LT(disc().value(conflict->at), 0.5) << name;
    for (const bool firstKeeps : {true, false}) {
      const modeling::TakeOverlap command = resolution(*conflict, firstKeeps, project);
      EXPECT_EQ(command.name, firstKeeps ? "base" : "hand");
      const Project resolved = modeling::apply(command, project).project;
      const TouchState rest = build(resolved)->rest();
      ASSERT_EQ(rest.supports.size(), 2U) << name;
      // "hand" lifts the body, "base" keeps it down.
      EXPECT_GT(rest.supports[1].resultant.force.z(), 0) << name << firstKeeps;
      EXPECT_LE((rest.supports[0].resultant.force + rest.supports[1].resultant.force).norm(),
                0.02 * rest.supports[1].resultant.force.norm())
          << name << firstKeeps;
    }
  }
}

TEST(Supports, EitherOfTwoMeetingPatchesCanLeaveAGap) {
  for (const Engine engine : {Engine::kTriangles, Engine::kSplines}) {
    Project project = test::freeBox(4);
    project.mesh.engine = engine;
    project.supports = {
        {"base", Support::Kind::kFixed, Region::ofPatches({"bottom"}), Vector3d::Zero()},
        {"side", Support::Kind::kFixed, Region::ofPatches({"side_xmin"}), {0.5, 0, 0}}};
    const auto conflict = conflictOf(project);
    ASSERT_TRUE(conflict);
    EXPECT_FALSE(conflict->overlaps);
    for (const bool firstKeeps : {true, false}) {
      const auto model =
          build(modeling::apply(resolution(*conflict, firstKeeps, project), project).project);
      EXPECT_GT(model->rest().supports[1].resultant.force.x(), 0) << firstKeeps;
    }
  }
}

// The border of this support bends within two triangles at some edge lengths. With triangles there
// that cannot carry the root of the distance, forces changed by 1.3 % from 4.2 to 3.8 mm.
TEST(Supports, ForcesDoNotDependOnTrianglesAtBendsOfTheBorder) {
  modeling::Primitive ring;
  ring.shape = modeling::TorusShape{13, 5};
  Project project = test::clampedSphere(6, 0.48);
  project.body = modeling::makePrimitive(ring);
  project.supports[0].where = Region::below({-0.30, -0.58, -0.757}, -4);
  project.mesh.engine = Engine::kQuadratic;
  project.touches = {{"pull", {11, -12, 4}, modeling::TouchKind::kGrab, {0.5, -0.57, 0.7}, 8.0}};
  const auto force = [&](double edgeLength) -> Vector3d {
    project.mesh.edgeLength = edgeLength;
    return playTouches(*build(project), project.touches).contacts[0].force;
  };
  const Vector3d expected = force(4.2);
  for (const double edgeLength : {3.8, 3.2})
    EXPECT_LE((force(edgeLength) - expected).norm(), 0.005 * expected.norm()) << edgeLength;
}

// Edges and corners inside a support have up to three unknown tractions at one node. With points at
// the nodes the condition of this box was 1e6 to 4e8.
TEST(Supports, AcrossSharpEdgesAreWellConditionedWithQuadraticTriangles) {
  modeling::Primitive box;
  box.shape = modeling::BoxShape{{40, 16, 30}};
  Project project = test::clampedSphere(6);
  project.body = modeling::makePrimitive(box);
  project.supports[0].where = Region::below({-0.52, -0.13, -0.845}, -12);
  project.mesh.engine = Engine::kQuadratic;
  for (const double length : {5.0, 4.0, 3.5, 3.0}) {
    project.mesh.edgeLength = length;
    EXPECT_LE(build(project)->problem()->conditionEstimate(), 1e5) << length;
  }
}

// Quadratic extrapolation by functions two rows away made conditions of 1e6 to 1e8 beside borders
// that run oblique to the knots; the stated error was beyond 100 %.
TEST(Supports, ObliqueBordersAreWellConditionedWithSplines) {
  Project project = test::clampedSphere(6, 0.3);
  project.mesh.engine = Engine::kSplines;
  project.mesh.accuracy = 0.1;
  const auto condition = [&](const auto& shape, const Vector3d& across, double height) {
    modeling::Primitive primitive;
    primitive.shape = shape;
    project.body = modeling::makePrimitive(primitive);
    project.supports[0].where = Region::below(across, height);
    return build(project)->problem()->conditionEstimate();
  };
  const modeling::TorusShape ring{20, 7};
  EXPECT_LE(condition(ring, {0.6, -1.1, 1.0}, 3), 2e5);
  EXPECT_LE(condition(ring, {-0.3, -0.7, -0.1}, -7), 2e5);
  EXPECT_LE(condition(modeling::CapsuleShape{12, 30}, {-0.5, 0.4, -0.9}, 11), 2e5);
}

}  // namespace
}  // namespace palpa::app

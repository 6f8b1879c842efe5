#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>

#include "app/core/model/build_phase.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/touch.h"
#include "bem/base/error.h"
#include "core_projects.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"

namespace palpa::app {
namespace {

using bem::SolverError;
using Eigen::Vector3d;
using modeling::Region;
using modeling::Support;

std::shared_ptr<const TouchModel> build(const modeling::Project& project,
                                        const BuildOptions& options = {}) {
  return buildTouchModel(project, options, Job{});
}

modeling::Touch grab(const Vector3d& at, const Vector3d& by, double radius) {
  return {"grab", at, modeling::TouchKind::kGrab, by, radius};
}

/// Expects a SolverError of a kind whose message contains all of `parts`.
template <class Work>
void expectRefused(SolverError::Kind kind, std::initializer_list<std::string> parts,
                   const Work& work) {
  try {
    work();
    FAIL() << "was not refused";
  } catch (const SolverError& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "\"" << part << "\" is not in: " << error.what();
  }
}

TEST(TouchModel, PressureOnAllOfAFreePartGivesItsResultant) {
  modeling::Project project = test::clampedCylinder(6);
  project.loads.push_back({"press", modeling::Pressure{Region::ofPatches({"top"}), 0.001}});
  const auto model = build(project);
  // The top is a polygon inscribed in the circle of radius 20: area pi 20^2 less some per cent.
  const double expected = 0.001 * 3.14159265 * 400;
  EXPECT_NEAR(model->setup().loads[0].resultant.force[2], -expected, 0.03 * expected);
  EXPECT_NEAR(model->rest().supports[0].resultant.force[2],
              -model->setup().loads[0].resultant.force[2], 0.01 * expected);
  EXPECT_LE(model->rest().relativeBalance, 0.01);
}

TEST(TouchModel, PressureOnAPaintedDiscGivesItsResultant) {
  modeling::Project project = test::clampedCylinder(6);
  project.loads.push_back(
      {"press", modeling::Pressure{{{modeling::Stroke{{{3, -2, 60}}, 8.0}}}, 0.001}});
  const auto model = build(project);
  const double expected = 0.001 * 3.14159265 * 64;
  EXPECT_NEAR(model->setup().loads[0].resultant.force[2], -expected, 0.1 * expected);
  EXPECT_NEAR(model->setup().loads[0].resultant.force.head<2>().norm(), 0.0, 1e-9 * expected);
  EXPECT_NEAR(model->rest().supports[0].resultant.force[2],
              -model->setup().loads[0].resultant.force[2], 0.01 * expected);
}

TEST(TouchModel, LoadOnASupportGoesStraightIntoIt) {
  modeling::Project project = test::clampedCylinder(8);
  project.loads.push_back(
      {"on the base", modeling::UniformTraction{Region::ofPatches({"bottom"}), {0, 0, -0.001}}});
  const auto model = build(project);
  EXPECT_NEAR(model->rest().supports[0].resultant.force[2],
              -model->setup().loads[0].resultant.force[2], 1e-9);
  EXPECT_LE(model->rest().field.u.norm(), 1e-9);
}

TEST(TouchModel, UniformCompressionOnRollersIsExact) {
  // A box on three rollers under pressure on top: u = -p/E (z - nu (x - x0), …), a linear field.
  modeling::Project project = test::freeBox(7);
  for (const char* side : {"bottom", "side_xmin", "side_ymin"})
    project.supports.push_back(
        {side, Support::Kind::kRoller, Region::ofPatches({side}), Vector3d::Zero()});
  project.loads.push_back({"press", modeling::Pressure{Region::ofPatches({"top"}), 0.01}});
  const auto model = build(project);
  const FieldSample corner = sampleField(*model, model->rest(), {20, 15, 20});
  EXPECT_NEAR(corner.displacement[2], -0.01 / 0.1 * 20, 1e-6);
  EXPECT_NEAR(corner.displacement[0], 0.45 * 0.01 / 0.1 * 40, 1e-6);
  EXPECT_NEAR(model->rest().supports[0].resultant.force[2], 0.01 * 40 * 30, 1e-6);
  EXPECT_NEAR(model->rest().energy, 0.5 * 0.01 * 0.01 / 0.1 * 40 * 30 * 20, 1e-6);
}

TEST(TouchModel, PrescribedDisplacementMovesAFreeBodyRigidly) {
  modeling::Project project = test::clampedCylinder(8);
  project.supports[0].displacement = Vector3d(0.5, -0.25, 1);
  const auto model = build(project);
  const FieldSample top = sampleField(*model, model->rest(), {0, 0, 60});
  EXPECT_LE((top.displacement - Vector3d(0.5, -0.25, 1)).norm(), 1e-6);
  EXPECT_LE(model->rest().supports[0].resultant.force.norm(), 1e-6);
}

TEST(Touch, RecordedTouchEqualsTheSameTouchAtOnce) {
  const auto model = build(test::clampedSphere(5));
  const TouchState alone = playTouches(*model, std::vector{grab({0, 0, 25}, {0, 0, -2}, 9)});
  ASSERT_EQ(alone.contacts.size(), 1U);
  EXPECT_LT(alone.contacts[0].force[2], 0);
  EXPECT_NEAR(alone.supports[0].resultant.force[2], -alone.contacts[0].force[2],
              0.01 * -alone.contacts[0].force[2]);
  EXPECT_LE(alone.relativeBalance, 0.01);
  EXPECT_NEAR(alone.energy, 0.5 * 2 * -alone.contacts[0].force[2], 0.01 * alone.energy);
}

TEST(Touch, PaintedSupportHoldsLikeTheSameCapOfAHalfSpace) {
  const auto cut = build(test::clampedSphere(4));
  const auto painted = build(test::paintedSphere(4));
  const std::vector touch{grab({0, 0, 25}, {1, 0, -2}, 9)};
  const TouchState one = playTouches(*cut, touch);
  const TouchState other = playTouches(*painted, touch);
  const Vector3d expected = one.contacts[0].force;
  EXPECT_LE((other.contacts[0].force - expected).norm(), 0.005 * expected.norm());
  EXPECT_LE((other.supports[0].resultant.force - one.supports[0].resultant.force).norm(),
            0.005 * expected.norm());
  EXPECT_LE(other.relativeBalance, 0.01);
}

TEST(Touch, ANodeMovesExactlyAsTold) {
  const auto model = build(test::clampedSphere(5));
  const int node = bem::nearestNode(model->setup().mesh(), {0, 0, 25});
  const TouchState state = touchNode(*model, node, {0, 0.1, -1});
  EXPECT_LE((state.field.u.col(0).segment<3>(3 * node) - Vector3d(0, 0.1, -1)).norm(), 1e-12);
  EXPECT_LE(state.relativeBalance, 0.01);
}

TEST(Touch, WithLoadsTheNodeIsMovedFromTheUnloadedShape) {
  modeling::Project project = test::clampedSphere(5);
  project.loads.push_back({"bump", modeling::Bump{{0, 0, 25}, 10, 0.002, {0, 0, -1}}});
  const auto model = build(project);
  const int node = bem::nearestNode(model->setup().mesh(), {0, 0, 25});
  const Vector3d there = model->rest().field.u.col(0).segment<3>(3 * node);
  // Told to be where the load has put it, it takes no force.
  EXPECT_LE(touchNode(*model, node, there).contacts[0].force.norm(), 1e-8);
}

TEST(Touch, RefusesHeldPlacesAndPlacesFarAway) {
  const auto model = build(test::clampedSphere(5));
  expectRefused(SolverError::Kind::kBadCondition, {"support"}, [&] {
    playTouches(*model, std::vector{grab({0, 0, -25}, {0, 0, 1}, 3)});
  });
  expectRefused(SolverError::Kind::kBadCondition, {"away from the surface", "35"}, [&] {
    playTouches(*model, std::vector{grab({0, 0, 60}, {0, 0, 1}, 3)});
  });
  expectRefused(SolverError::Kind::kBadCondition, {"no node 100000"},
                [&] { touchNode(*model, 100000, Vector3d::Zero()); });
}

TEST(Refused, ASampleFarFromTheSurfaceNamesTheNearestPoint) {
  const auto model = build(test::clampedSphere(6));
  expectRefused(SolverError::Kind::kBadCondition, {"the sample", "nearest surface point"}, [&] {
    sampleField(*model, model->rest(), {0, 0, 0});
  });
}

TEST(Refused, NotHeld) {
  expectRefused(SolverError::Kind::kNotFixed, {"not fixed", "support"},
                [] { build(test::freeBox(8)); });
  modeling::Project project = test::freeBox(8);
  project.supports.push_back(
      {"floor", Support::Kind::kRoller, Region::ofPatches({"bottom"}), Vector3d::Zero()});
  expectRefused(SolverError::Kind::kNotFixed,
                {"translation along x", "translation along y", "rotation about the axis along z"},
                [&] { build(project); });
}

TEST(Refused, IncompressibleAndHeldEverywhere) {
  modeling::Project project = test::freeBox(8);
  project.material.poissonRatio = 0.5;
  project.supports.push_back(
      {"all", Support::Kind::kFixed,
       Region::ofPatches({"top", "bottom", "side_xmin", "side_xmax", "side_ymin", "side_ymax"}),
       Vector3d::Zero()});
  expectRefused(SolverError::Kind::kIncompressible, {"0.5"}, [&] { build(project); });
}

TEST(Refused, SupportsThatOverlapOrDisagree) {
  modeling::Project project = test::clampedCylinder(8);
  project.supports.push_back({"low", Support::Kind::kFixed,
                              Region::below(Eigen::Vector3d::UnitZ(), 10), Vector3d(0, 0, 1)});
  expectRefused(SolverError::Kind::kBadCondition, {"\"base\"", "\"low\"", "overlap"},
                [&] { build(project); });
  project = test::clampedCylinder(8);
  project.supports.push_back(
      {"side", Support::Kind::kFixed, Region::ofPatches({"side_xmin"}), Vector3d(1, 0, 0)});
  expectRefused(SolverError::Kind::kBadCondition, {"\"base\"", "\"side\"", "different"},
                [&] { build(project); });
}

TEST(Refused, AMeshThatDoesNotFitIntoMemoryWithTheNumbers) {
  BuildOptions options;
  options.edgeLength = 0.05;
  expectRefused(SolverError::Kind::kTooLarge,
                {"0.05 mm", " GiB of memory for ", ",", " nodes", "longer"},
                [&] { build(test::clampedSphere(5), options); });
  options.edgeLength = 3;
  options.memoryLimit = 1e6;
  expectRefused(SolverError::Kind::kTooLarge, {"3 mm", "1 MiB"},
                [&] { build(test::clampedSphere(5), options); });
}

TEST(TouchModel, CanBeCancelledInEveryPhase) {
  for (const Phase phase : {Phase::kMesh, Phase::kAssemble, Phase::kFactorise}) {
    std::stop_source stop;
    Job job;
    job.stop = stop.get_token();
    job.progress = [&](Phase now, double) {
      if (now == phase) stop.request_stop();
    };
    EXPECT_THROW(buildTouchModel(test::clampedSphere(4), BuildOptions{}, job), Cancelled)
        << nameOf(phase);
  }
}

TEST(TouchModel, ProgressIsMonotoneWithinEachPhase) {
  std::optional<Phase> phase;
  double last = 0;
  Job job;
  job.progress = [&](Phase now, double fraction) {
    if (now != phase) last = 0;
    phase = now;
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
  };
  buildTouchModel(test::clampedSphere(6), BuildOptions{}, job);
  EXPECT_EQ(phase, Phase::kSolve);
}

TEST(BuildPhases, CoverEveryPhaseThatABuildReports) {
  const auto isListed = [](Phase phase) {
    return std::count_if(kBuildPhases.begin(), kBuildPhases.end(),
                         [&](const BuildPhase& each) { return each.phase == phase; }) == 1;
  };
  double progress = 0;
  BuildProgress shares;
  Job job;
  job.progress = [&](Phase phase, double fraction) {
    ASSERT_TRUE(isListed(phase)) << nameOf(phase);
    EXPECT_GE(shares.at(phase, fraction), progress) << nameOf(phase);
    progress = shares.at(phase, fraction);
  };
  buildTouchModel(test::clampedSphere(6), BuildOptions{}, job);
  EXPECT_EQ(progress, 1);
  EXPECT_TRUE(isListed(Phase::kRead));    // core_cache_test
  EXPECT_TRUE(isListed(Phase::kUpdate));  // core_update_test
}

TEST(BuildPhases, SharesAreTheTimesOfTheLastBuild) {
  BuildProgress progress;
  for (const auto& [phase, seconds] :
       {std::pair(Phase::kMesh, 8.0), std::pair(Phase::kCheck, 1.0), std::pair(Phase::kSetup, 0.5),
        std::pair(Phase::kAssemble, 4.0), std::pair(Phase::kFactorise, 6.0),
        std::pair(Phase::kSolve, 0.5)})
    progress.learn(phase, seconds);
  EXPECT_DOUBLE_EQ(progress.at(Phase::kMesh, 0.5), 4.0 / 20);
  EXPECT_DOUBLE_EQ(progress.at(Phase::kAssemble, 0.25), 10.5 / 20);
  EXPECT_DOUBLE_EQ(progress.at(Phase::kSolve, 1), 1);
  // A stored model replaces assembly and factorisation.
  progress.restart();
  progress.learn(Phase::kRead, 2);
  EXPECT_DOUBLE_EQ(progress.at(Phase::kRead, 0.5), 10.5 / 12);
}

TEST(BuildPhases, EveryStageOfAMeshBodyAdvances) {
  modeling::Project project = test::clampedSphere(3);
  const modeling::SurfaceMesh mesh = modeling::mesh(project.body, project.mesh);
  project.body = modeling::MeshBody(
      {mesh.positions, mesh.triangles, std::vector<int>(mesh.triangles.size(), 0), {"face"}});
  std::map<Phase, std::set<double>> seen;
  std::mutex mutex;
  Job job;
  job.progress = [&](Phase phase, double fraction) {
    const std::lock_guard lock(mutex);
    seen[phase].insert(fraction);
  };
  buildTouchModel(project, BuildOptions{}, job);
  EXPECT_GE(seen[Phase::kMesh].size(), 20U);
  EXPECT_GE(seen[Phase::kCheck].size(), 3U);
  EXPECT_GE(seen[Phase::kAssemble].size(), 5U);
  EXPECT_GE(seen[Phase::kFactorise].size(), 5U);
}

TEST(TouchModel, WorksForIncompressibleBodies) {
  const auto model = build(test::clampedSphere(4, 0.5));
  const TouchState state = playTouches(*model, std::vector{grab({0, 0, 25}, {0, 0, -2}, 9)});
  const auto nearly = build(test::clampedSphere(4, 0.499));
  const TouchState other = playTouches(*nearly, std::vector{grab({0, 0, 25}, {0, 0, -2}, 9)});
  // Continuous in nu: the limit differs by the order of the change.
  EXPECT_NEAR(state.contacts[0].force[2], other.contacts[0].force[2],
              0.01 * std::abs(other.contacts[0].force[2]));
}

}  // namespace
}  // namespace palpa::app

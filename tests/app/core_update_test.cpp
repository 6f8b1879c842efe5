// Incremental updates of models of moved shapes, with both engines.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/core/results/touch.h"
#include "app/core/session/rebuild_pipeline.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/dense/update_reference_problem.h"
#include "core_projects.h"
#include "modeling/shapes/primitives.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using State = RebuildStatus::State;

/// With so many control points that one of them moves a small part.
modeling::Project sphere(modeling::Engine engine) {
  modeling::Project project = test::clampedSphere(3);
  const modeling::Solid solid = modeling::makeSphere(25, 11);
  project.supports[0].where = modeling::Region::ofPatches({solid.patches().front().name});
  project.body = solid;
  project.mesh.engine = engine;
  project.mesh.elementLength = 6.0;
  return project;
}

/// The control point nearest to a place is moved.
modeling::Project pulled(modeling::Project project, const Vector3d& at, const Vector3d& by) {
  auto& solid = std::get<modeling::Solid>(project.body);
  std::vector<Vector3d> points = solid.controlPoints();
  *std::min_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  }) += by;
  project.body = solid.withControlPoints(std::move(points));
  return project;
}

/// Away from the support.
Vector3d outOf(const modeling::Project& project) {
  const auto& solid = std::get<modeling::Solid>(project.body);
  Vector3d held = Vector3d::Zero();
  for (const auto& row : solid.patches().front().net)
    for (const int point : row) held += solid.controlPoints()[point];
  return -held.normalized();
}

/// The force (N) of a grab that moves the surface at a place by 1 mm.
Vector3d forceAt(const TouchModel& model, const Vector3d& at) {
  modeling::Touch touch;
  touch.at = at;
  touch.radius = 6.0;
  touch.kind = modeling::TouchKind::kGrab;
  touch.vector = {0.3, -0.2, -1};
  return playTouches(model, {&touch, 1}).contacts.front().force;
}

/// Largest difference between the displacements of forces everywhere and the displacements computed
/// with factors of the same discretisation, over the largest displacement.
double differenceFromFullRebuild(const TouchModel& update) {
  const BoundarySetup& setup = update.setup();
  const auto own = bem::makeDenseReferenceProblem(
      *setup.discretisation, {setup.conditions.ofSlot, setup.material, bem::AssemblyOptions{1e-5},
                              bem::Precision::kDouble});
  const bem::ReferenceProblem& problem = *update.problem();
  const auto u = [&](const bem::ReferenceProblem& of) {
    const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(of.dofs().nodalCount(), -1, 1);
    return of
        .solveField(problem.dofs().expand(Eigen::VectorXd::Zero(problem.dofs().count()), forces))
        .u;
  };
  const Eigen::MatrixXd ofOwn = u(*own);
  return (u(problem) - ofOwn).lpNorm<Eigen::Infinity>() / ofOwn.lpNorm<Eigen::Infinity>();
}

class Update : public testing::TestWithParam<modeling::Engine> {};

TEST_P(Update, IsTouchedLikeAModelOfItsOwn) {
  const modeling::Project project = sphere(GetParam());
  const auto former = buildTouchModel(project, {}, {});
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const Vector3d place = 25 * outOf(project);
  for (int edit = 0; edit < 3; ++edit) {
    const Vector3d at = (place + 5 * Vector3d(normal(random), normal(random), normal(random)));
    const auto edited = pulled(project, at, 3 * at.normalized());
    const auto update = updateTouchModel(edited, project, *former, {}, {});
    ASSERT_TRUE(update) << edit;
    EXPECT_LE(update->report().residual.value(), 1e-5);
    EXPECT_LE(differenceFromFullRebuild(*update), 1e-6) << edit;
    const auto own = buildTouchModel(edited, {}, {});
    EXPECT_FALSE(own->report().residual);
    const Vector3d ofUpdate = forceAt(*update, place), ofOwn = forceAt(*own, place);
    // Triangles are others on a dent that is hardly wider than they are: the mesh was carried
    // along.
    const double limit = GetParam() == modeling::Engine::kTriangles ? 0.03 : 1e-4;
    EXPECT_LE((ofUpdate - ofOwn).norm(), limit * ofOwn.norm()) << edit;
    EXPECT_GE((forceAt(*former, place) - ofOwn).norm(), 0.005 * ofOwn.norm()) << edit;
  }
}

TEST_P(Update, IsLeftToBuildingAnewWhenMoreThanControlPointsChanged) {
  const modeling::Project project = sphere(GetParam());
  const auto former = buildTouchModel(project, {}, {});
  const auto update = [&](const modeling::Project& edited) {
    return updateTouchModel(edited, project, *former, {}, {});
  };
  const modeling::Project moved = pulled(project, 25 * outOf(project), outOf(project));
  const auto updated = update(moved);
  ASSERT_TRUE(updated);
  EXPECT_FALSE(updateTouchModel(pulled(moved, {25, 0, 0}, {1, 0, 0}), moved, *updated, {}, {}));
  modeling::Project other = moved;
  other.material.poissonRatio = 0.3;
  EXPECT_FALSE(update(other));
  other = moved;
  other.supports.clear();
  EXPECT_FALSE(update(other));
  other = moved;
  other.mesh.edgeLength *= 0.9;
  EXPECT_FALSE(update(other));
  other = moved;
  other.body = modeling::makeSphere(25, 8);
  EXPECT_FALSE(update(other));
}

TEST_P(Update, TheProblemIsKeptWhenNothingItDependsOnChanges) {
  modeling::Project project = sphere(GetParam());
  const auto former = buildTouchModel(project, {}, {});
  project.supports.front().displacement = {0, 0, 1};
  const auto model = buildTouchModel(project, {}, {}, former.get());
  EXPECT_EQ(model->problem(), former->problem());
  EXPECT_NE(model->rest().field.u, former->rest().field.u);
  const auto moved =
      buildTouchModel(pulled(project, 25 * outOf(project), outOf(project)), {}, {}, former.get());
  EXPECT_NE(moved->problem(), former->problem());
}

TEST_P(Update, ComesFirstAndIsReplaced) {
  std::atomic<int> updates = 0;
  RebuildPipeline* watched = nullptr;
  RebuildPipeline pipeline({}, 0, [&] {
    if (!watched) return;
    const RebuildStatus status = watched->status();
    if (status.state == State::kBuilding && status.modelRevision == status.revision &&
        status.residual && *status.residual < 1e-5)
      ++updates;
  });
  const modeling::Project project = sphere(GetParam());
  pipeline.submit(project);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  watched = &pipeline;
  EXPECT_FALSE(pipeline.status().residual);
  const auto edited = pulled(project, 25 * outOf(project), 2 * outOf(project));
  pipeline.submit(edited);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_GT(updates, 0);
  const RebuildStatus status = pipeline.status();
  EXPECT_EQ(status.state, State::kUpToDate);
  EXPECT_FALSE(status.residual);
  EXPECT_EQ(status.stages.front().phase, Phase::kUpdate);
  const auto model = pipeline.model();
  EXPECT_FALSE(model->report().residual);
  // To the bit what a pipeline without a past makes of the same project.
  EXPECT_EQ(model->surface().positions, buildTouchModel(edited, {}, {})->surface().positions);
  watched = nullptr;
}

/// Averaged equations along the border of a support, which share points.
TEST(SplineUpdate, FollowsEditsBesideABorderThatCutsPatches) {
  modeling::Project project = sphere(modeling::Engine::kSplines);
  project.supports[0].where = modeling::Region::below(Vector3d(0.2, -0.1, 1), -15);
  project.mesh.elementLength = 9.0;
  const auto former = buildTouchModel(project, {}, {});
  for (const double z : {25.0, -12.0, -16.0}) {
    const Vector3d at(std::sqrt(25.0 * 25.0 - z * z), 0, z);
    const auto update = updateTouchModel(pulled(project, at, at / 25), project, *former, {}, {});
    // Where the border itself moves, its cuts may change: then there is none.
    if (z > 0) {
      ASSERT_TRUE(update);
    }
    if (update) {
      EXPECT_LE(differenceFromFullRebuild(*update), 1e-6) << z;
    }
  }
}

/// The averaged equations of a cut patch once divided by the number of moved coefficients.
TEST(SplineUpdate, MovesOfNothingAreEqualModels) {
  modeling::Project project = sphere(modeling::Engine::kSplines);
  project.supports[0].where = modeling::Region::below(Vector3d(0.2, -0.1, 1), -15);
  project.mesh.elementLength = 9.0;
  const auto former = buildTouchModel(project, {}, {});
  modeling::Project renamed = project;
  renamed.name = "other";
  EXPECT_FALSE(updateTouchModel(renamed, project, *former, {}, {}));
  const BoundarySetup& setup = former->setup();
  const bem::ProblemInputs inputs{setup.conditions.ofSlot, setup.material};
  const auto updated = bem::updateDenseReferenceProblem(former->problem(), *setup.discretisation,
                                                        *setup.discretisation, inputs);
  ASSERT_TRUE(updated);
  const auto u = [&](const bem::ReferenceProblem& of) {
    const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(of.dofs().nodalCount(), -1, 1);
    return of.solveField(of.dofs().expand(Eigen::VectorXd::Zero(of.dofs().count()), forces)).u;
  };
  const Eigen::MatrixXd before = u(*former->problem());
  EXPECT_LE((u(*updated) - before).lpNorm<Eigen::Infinity>(),
            1e-6 * before.lpNorm<Eigen::Infinity>());
}

INSTANTIATE_TEST_SUITE_P(Engines, Update,
                         testing::Values(modeling::Engine::kTriangles, modeling::Engine::kSplines),
                         [](const auto& engine) {
                           return engine.param == modeling::Engine::kTriangles ? "triangles"
                                                                               : "splines";
                         });

}  // namespace
}  // namespace palpa::app

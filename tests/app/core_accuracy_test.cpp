// Requested and reached accuracy, and the mesh that reaches the requested one.
#include "app/core/results/accuracy_advice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/model/build_touch_model.h"
#include "app/core/session/rebuild_pipeline.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using Limit = AccuracyAdvice::Limit;

std::shared_ptr<const TouchModel> build(const modeling::Project& project) {
  return buildTouchModel(project, {}, {});
}

modeling::Project triangleSphere(double edgeLength) {
  modeling::Project project = test::clampedSphere(edgeLength);
  project.mesh.engine = modeling::Engine::kTriangles;
  return project;
}

AccuracyAdvice advise(const modeling::Project& project, const TouchModel& model,
                      const std::optional<AccuracySample>& former = {}, double memoryLimit = 0) {
  BuildOptions options;
  options.memoryLimit = memoryLimit;
  return adviseAccuracy(project, model, estimateTouchError(model, {}), former, options, {});
}

/// Presses beside supports have larger errors; where they lie by chance must not decide.
TEST(TouchError, IsOfPlacesAwayFromSupports) {
  std::vector<double> errors;
  for (const double edge : {4.0, 5.0, 6.0})
    errors.push_back(estimateTouchError(*build(triangleSphere(edge)), {}).relative);
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  EXPECT_LT(*most, 1.5 * *least);
  EXPECT_LT(*most, 0.5);
}

TEST(AccuracyAdvice, ARequestThatIsMetNeedsNothing) {
  modeling::Project project = test::clampedCylinder(8);
  project.mesh.accuracy = 0.05;
  project.mesh.splineDensity = 1.5;
  const AccuracyAdvice advice = advise(project, *build(project));
  EXPECT_EQ(advice.limit, Limit::kNone);
  EXPECT_FALSE(advice.mesh);
  EXPECT_LE(advice.reached, 0.05);
}

TEST(AccuracyAdvice, TrianglesGetAShorterEdge) {
  modeling::Project project = triangleSphere(5);
  project.mesh.accuracy = 0.1;
  const auto model = build(project);
  const TouchError error = estimateTouchError(*model, {});
  ASSERT_GT(error.relative, 0.1);
  ASSERT_GT(error.widening, 1.05);
  const AccuracyAdvice advice = advise(project, *model);
  EXPECT_EQ(advice.limit, Limit::kTouch);
  ASSERT_TRUE(advice.mesh);
  EXPECT_TRUE(advice.isEnough);
  // Contacts are as narrow as a fingertip first.
  EXPECT_LT(advice.mesh->edgeLength, 5 / error.widening);
  modeling::MeshSettings unchanged = *advice.mesh;
  unchanged.edgeLength = 5;
  EXPECT_EQ(unchanged, project.mesh);
  project.mesh = *advice.mesh;
  const auto finer = build(project);
  EXPECT_NEAR(finer->setup().discretisation->displacementCount(), advice.coefficients,
              0.3 * advice.coefficients);
  const TouchError reached = estimateTouchError(*finer, {});
  EXPECT_LT(reached.relative, 0.1 * 1.25);
  EXPECT_LT(reached.widening, 1.1);
}

TEST(AccuracyAdvice, SplinesGetDenser) {
  modeling::Project project = test::clampedCylinder(10);
  project.mesh.elementLength = 14;
  const auto coarse = build(project);
  const AccuracyAdvice byLength = adviseAccuracy(project, *coarse, TouchError{0.02, 1}, {}, {}, {});
  EXPECT_EQ(byLength.limit, Limit::kElementLength);
  ASSERT_TRUE(byLength.mesh && byLength.mesh->elementLength);
  EXPECT_NEAR(*byLength.mesh->elementLength, 14 / (1.05 * std::cbrt(2)), 0.1);
  EXPECT_EQ(byLength.mesh->splineDensity, 1);
  // Without a given length the density changes; the request is half of the stated error.
  project.mesh.elementLength.reset();
  project.mesh.accuracy = 0.1;
  const auto model = build(project);
  const AccuracyAdvice advice = adviseAccuracy(project, *model, TouchError{0.2, 1}, {}, {}, {});
  EXPECT_TRUE(advice.limit == Limit::kElementSize || advice.limit == Limit::kBuildTime);
  ASSERT_TRUE(advice.mesh);
  EXPECT_EQ(advice.order, 3);
  EXPECT_NEAR(advice.mesh->splineDensity, 1.05 * std::cbrt(2), 0.01);
  EXPECT_EQ(advice.mesh->accuracy, 0.1);
  project.mesh = *advice.mesh;
  const auto finer = build(project);
  EXPECT_NEAR(finer->setup().discretisation->displacementCount(), advice.coefficients,
              0.2 * advice.coefficients);
  EXPECT_LT(estimateTouchError(*finer, {}).relative, estimateTouchError(*model, {}).relative);
}

TEST(AccuracyAdvice, UsesTheOrderThatTwoMeshesShow) {
  modeling::Project project = test::clampedCylinder(8);
  project.mesh.elementLength = 12;
  const auto model = build(project);
  const int count = model->setup().discretisation->displacementCount();
  const TouchError error{0.04, 1};
  // Four times the coefficients: half the length, and the error fell from 0.16 to 0.04.
  const AccuracySample former{count / 4, {0.16, 1}};
  const AccuracyAdvice advice = adviseAccuracy(project, *model, error, former, {}, {});
  EXPECT_NEAR(advice.order, 2, 0.01);
  ASSERT_TRUE(advice.mesh && advice.mesh->elementLength);
  EXPECT_NEAR(*advice.mesh->elementLength, 12 / (1.05 * 2), 0.06);
  // Triangles under contacts wider than a fingertip show none.
  const modeling::Project coarse = triangleSphere(7);
  const auto triangles = build(coarse);
  const int nodes = triangles->setup().discretisation->displacementCount();
  for (const double widening : {1.0, 1.5})
    EXPECT_NEAR(adviseAccuracy(coarse, *triangles, error,
                               AccuracySample{nodes / 4, {0.32, widening}}, {}, {})
                    .order,
                widening > 1 ? 2 : 3, 0.05);
}

TEST(AccuracyAdvice, IsLimitedByMemory) {
  const modeling::Project project = triangleSphere(5);
  const auto model = build(project);
  const double now = model->report().memory;
  const AccuracyAdvice free = advise(project, *model, {}, 1e15);
  ASSERT_TRUE(free.mesh);
  EXPECT_TRUE(free.isEnough);
  const AccuracyAdvice limited = advise(project, *model, {}, 4 * now);
  ASSERT_TRUE(limited.mesh);
  EXPECT_FALSE(limited.isEnough);
  EXPECT_GT(limited.mesh->edgeLength, free.mesh->edgeLength);
  EXPECT_LE(limited.bytes, 4 * now);
  EXPECT_GT(limited.neededBytes, 4 * now);
  EXPECT_GT(limited.expected, limited.requested);
  EXPECT_LE(limited.expected, limited.reached);
  const AccuracyAdvice none = advise(project, *model, {}, now);
  EXPECT_FALSE(none.mesh);
  EXPECT_GT(none.neededBytes, now);
}

TEST(AccuracyAdvice, IsPartOfTheStatus) {
  RebuildPipeline pipeline;
  modeling::Project project = triangleSphere(7);
  const auto advice = [&] {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!pipeline.status().accuracy && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(5ms);
    return pipeline.status().accuracy;
  };
  pipeline.submit(project);
  const auto first = advice();
  ASSERT_TRUE(first && first->mesh);
  EXPECT_EQ(first->requested, 0.01);
  EXPECT_EQ(first->reached, pipeline.status().touchError);
  EXPECT_EQ(first->order, 2);
  project.mesh.accuracy = 0.1;
  pipeline.submit(project);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const auto second = advice();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->requested, 0.1);
  EXPECT_EQ(second->reached, first->reached);
}

}  // namespace
}  // namespace palpa::app

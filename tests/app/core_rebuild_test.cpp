#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "app/core/session/rebuild_pipeline.h"
#include "app/core/system/destroy_in_background.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using State = RebuildStatus::State;

/// A sphere whose control points are scaled, so that every revision has another volume.
modeling::Project scaledSphere(double scale, double edgeLength = 12) {
  modeling::Project project = test::clampedSphere(edgeLength);
  auto& solid = std::get<modeling::Solid>(project.body);
  std::vector<Eigen::Vector3d> points = solid.controlPoints();
  for (Eigen::Vector3d& point : points) point *= scale;
  project.body = solid.withControlPoints(std::move(points));
  return project;
}

double radiusOf(const TouchModel& model) {
  double largest = 0;
  for (const Eigen::Vector3d& position : model.surface().positions)
    largest = std::max(largest, position.norm());
  return largest;
}

TEST(RebuildPipeline, StartsEmptyAndDeliversWhatWasSubmitted) {
  RebuildPipeline pipeline;
  EXPECT_EQ(pipeline.status().state, State::kEmpty);
  EXPECT_EQ(pipeline.model(), nullptr);
  EXPECT_EQ(pipeline.submit(scaledSphere(1.0)), 1u);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_EQ(pipeline.status().state, State::kUpToDate);
  EXPECT_EQ(pipeline.status().modelRevision, 1u);
  EXPECT_NEAR(radiusOf(*pipeline.model()), 25.0, 0.01);
}

TEST(RebuildPipeline, AStormOfEditsEndsWithTheModelOfTheLastOne) {
  RebuildPipeline pipeline;
  constexpr int kEdits = 1000;
  for (int i = 1; i <= kEdits; ++i) {
    pipeline.submit(scaledSphere(1.0 + 1e-4 * i));
    if (i % 100 == 0) std::this_thread::sleep_for(20ms);  // let some builds get far
  }
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const RebuildStatus status = pipeline.status();
  EXPECT_EQ(status.state, State::kUpToDate);
  EXPECT_EQ(status.revision, static_cast<std::uint64_t>(kEdits));
  EXPECT_EQ(status.modelRevision, static_cast<std::uint64_t>(kEdits));
  EXPECT_NEAR(radiusOf(*pipeline.model()), 25.0 * 1.1, 0.01);
}

TEST(RebuildPipeline, HoldsAMotionBackUntilTheHandLetsGo) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0), 1h);
  pipeline.submit(scaledSphere(1.1), 1h);
  EXPECT_FALSE(pipeline.waitUntilSettled(300ms));
  EXPECT_EQ(pipeline.status().state, State::kBuilding);
  EXPECT_TRUE(pipeline.status().stages.empty());
  pipeline.startPending();
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_NEAR(radiusOf(*pipeline.model()), 27.5, 0.01);
}

TEST(RebuildPipeline, BuildsAMotionWhenTheHandRests) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0), 50ms);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_EQ(pipeline.status().modelRevision, 1u);
  // What comes without a rest replaces what is held back.
  pipeline.submit(scaledSphere(1.0), 1h);
  pipeline.submit(scaledSphere(1.2));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_NEAR(radiusOf(*pipeline.model()), 30.0, 0.01);
}

TEST(RebuildPipeline, ModelsThatNobodyHoldsAnyMoreAreReleased) {
  std::weak_ptr<const TouchModel> first;
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  first = pipeline.model();
  pipeline.submit(scaledSphere(1.1));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  // The worker lets go of it right after it announced the new one.
  for (int i = 0; i < 1000 && !first.expired(); ++i) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(first.expired());
}

TEST(RebuildPipeline, WhoeverHoldsAModelLastDoesNotReleaseIt) {
  struct Held {
    std::thread::id& releasedBy;
    ~Held() { releasedBy = std::this_thread::get_id(); }
  };
  std::thread::id releasedBy;
  destroyInBackground(std::shared_ptr<Held>(new Held{releasedBy}));
  waitUntilDestroyed();
  EXPECT_NE(releasedBy, std::thread::id());
  EXPECT_NE(releasedBy, std::this_thread::get_id());
  destroyInBackground(nullptr);

  std::shared_ptr<const TouchModel> last;
  {
    RebuildPipeline pipeline;
    pipeline.submit(scaledSphere(1.0));
    ASSERT_TRUE(pipeline.waitUntilSettled(60s));
    last = pipeline.model();
  }
  const std::weak_ptr<const bem::ReferenceProblem> problem = last->problem();
  last.reset();
  waitUntilDestroyed();
  EXPECT_TRUE(problem.expired());
}

TEST(RebuildPipeline, AnErrorReachesThePersonAndTheLastGoodModelStays) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const auto good = pipeline.model();
  modeling::Project loose = scaledSphere(1.0);
  loose.supports.clear();
  pipeline.submit(loose);
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_EQ(pipeline.status().state, State::kFailed);
  EXPECT_FALSE(pipeline.status().error.empty());
  EXPECT_EQ(pipeline.status().modelRevision, 1u);
  EXPECT_EQ(pipeline.model(), good);
  pipeline.submit(scaledSphere(1.05));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_EQ(pipeline.status().state, State::kUpToDate);
  EXPECT_TRUE(pipeline.status().error.empty());
}

TEST(RebuildPipeline, CancelKeepsTheOldModelAndIsASettledState) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const auto before = pipeline.model();
  pipeline.cancel();  // nothing runs: no change
  EXPECT_EQ(pipeline.status().state, State::kUpToDate);
  pipeline.submit(scaledSphere(1.1, 2.5));  // some 1,500 nodes: long enough to be stopped
  pipeline.cancel();
  EXPECT_TRUE(pipeline.waitUntilSettled(1s));
  EXPECT_EQ(pipeline.status().state, State::kCancelled);
  EXPECT_EQ(pipeline.model(), before);
}

TEST(RebuildPipeline, ReportsPhasesAndTellsOfEveryChange) {
  std::atomic<int> changes{0};
  std::mutex mutex;
  std::vector<Phase> phases;
  RebuildPipeline* seen = nullptr;
  RebuildPipeline pipeline({}, 0, [&] {
    ++changes;
    const std::lock_guard lock(mutex);
    if (!seen) return;
    const std::optional<Phase> phase = seen->status().phase;
    if (phase && (phases.empty() || phases.back() != *phase)) phases.push_back(*phase);
  });
  {
    const std::lock_guard lock(mutex);
    seen = &pipeline;
  }
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const std::lock_guard lock(mutex);
  const std::vector expected{Phase::kMesh,     Phase::kCheck,     Phase::kSetup,
                             Phase::kAssemble, Phase::kFactorise, Phase::kSolve};
  EXPECT_EQ(phases, expected);
  const RebuildStatus status = pipeline.status();
  std::vector<Phase> stages;
  for (const BuildStage& stage : status.stages) {
    stages.push_back(stage.phase);
    EXPECT_EQ(stage.fraction, 1.0) << nameOf(stage.phase);
    EXPECT_GE(stage.seconds, 0.0) << nameOf(stage.phase);
  }
  EXPECT_EQ(stages, expected);
  EXPECT_EQ(status.progress, 1.0);
  EXPECT_GE(changes, 6);
}

TEST(RebuildPipeline, ProgressNeverFalls) {
  std::mutex mutex;
  std::vector<double> seen;
  RebuildPipeline* pipelineSeen = nullptr;
  RebuildPipeline pipeline({}, 0, [&] {
    const std::lock_guard lock(mutex);
    if (pipelineSeen) seen.push_back(pipelineSeen->status().progress);
  });
  {
    const std::lock_guard lock(mutex);
    pipelineSeen = &pipeline;
  }
  pipeline.submit(scaledSphere(1.0, 6));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const std::lock_guard lock(mutex);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_GT(seen.size(), 10u);
}

TEST(RebuildPipeline, TheConditionNumberFollowsTheModel) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  for (int i = 0; i < 5000 && pipeline.status().condition == 0; ++i)
    std::this_thread::sleep_for(1ms);
  EXPECT_GT(pipeline.status().condition, 1.0);
  // Threaded sums may be added in another order the second time.
  const double condition = pipeline.model()->problem()->conditionEstimate();
  EXPECT_NEAR(pipeline.status().condition, condition, 1e-4 * condition);
}

/// The point of the net that is highest is pulled down through the body.
modeling::Project pierced() {
  modeling::Project project = scaledSphere(1.0, 5);
  auto& solid = std::get<modeling::Solid>(project.body);
  std::vector<Eigen::Vector3d> points = solid.controlPoints();
  const auto highest = std::max_element(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.z() < b.z(); });
  highest->z() -= 400;
  project.body = solid.withControlPoints(std::move(points));
  return project;
}

TEST(RebuildPipeline, ASurfaceThatCutsItselfIsNotBuiltAndTheFindingsSayWhere) {
  RebuildPipeline pipeline;
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const auto good = pipeline.model();
  EXPECT_TRUE(pipeline.status().findings->empty());
  pipeline.submit(pierced());
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  RebuildStatus status = pipeline.status();
  EXPECT_EQ(status.state, State::kFailed);
  ASSERT_FALSE(status.findings->empty());
  EXPECT_TRUE(status.findings->front().isError);
  EXPECT_EQ(status.error,
            status.findings->front().message + "; move its control points apart there");
  EXPECT_EQ(status.stages.back().phase, Phase::kCheck);
  EXPECT_EQ(pipeline.model(), good);
  pipeline.submit(scaledSphere(1.1));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  EXPECT_TRUE(pipeline.status().findings->empty());
  EXPECT_THROW(buildTouchModel(pierced(), {}, {}), GeometryError);
}

TEST(RebuildPipeline, CanBeDestroyedWhileItBuilds) {
  for (int i = 0; i < 20; ++i) {
    RebuildPipeline pipeline;
    pipeline.submit(scaledSphere(1.0, 2.5));
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * i));
  }
}

}  // namespace
}  // namespace palpa::app

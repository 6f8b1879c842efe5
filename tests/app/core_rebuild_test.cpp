#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "app/core/rebuild_pipeline.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
using State = RebuildStatus::State;

/// A sphere whose control points are scaled, so that every revision has a volume of its own.
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
  std::vector<std::string> phases;
  RebuildPipeline* seen = nullptr;
  RebuildPipeline pipeline({}, 0, [&] {
    ++changes;
    const std::lock_guard lock(mutex);
    if (!seen) return;
    const std::string phase = seen->status().phase;
    if (!phase.empty() && (phases.empty() || phases.back() != phase)) phases.push_back(phase);
  });
  {
    const std::lock_guard lock(mutex);
    seen = &pipeline;
  }
  pipeline.submit(scaledSphere(1.0));
  ASSERT_TRUE(pipeline.waitUntilSettled(60s));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(phases, (std::vector<std::string>{"mesh", "assemble", "factorise", "solve"}));
  EXPECT_GE(changes, 6);
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

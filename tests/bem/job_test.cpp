#include "base/job.h"
#include "bem/dense/make_reference_problem.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <stdexcept>

#include "app/verification/exact/simple_meshes.h"
#include "base/parallel.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {
namespace {

/// Sphere of 218 nodes with a fixed lower part.
struct Sphere {
  BoundaryMesh mesh = verification::sphereMesh(25, 6);
  std::unique_ptr<TractionSlots> slots;
  std::vector<SlotCondition> conditions;

  Sphere() {
    for (int t = 0; t < mesh.triangleCount(); ++t)
      mesh.tags[t] = mesh.point(t, Eigen::Vector3d::Constant(1.0 / 3))[2] < -15 ? 1 : 0;
    slots = std::make_unique<TractionSlots>(mesh);
    for (const auto& slot : slots->slots)
      conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  }
  std::unique_ptr<ReferenceProblem> solve(const Job& job) const {
    return makeDenseReferenceProblem(mesh, *slots,
                                     {conditions, {0.1, 0.45}, {}, Precision::kDouble}, job);
  }
};

TEST(Job, ProgressIsMonotoneWithinEachPhaseAndEndsAtOne) {
  for (const int threads : {1, 2}) {
    std::map<Phase, double> last;
    std::vector<Phase> order;
    Job job;
    job.threads = threads;
    job.progress = [&](Phase phase, double fraction) {
      const auto [place, isNew] = last.try_emplace(phase, 0.0);
      if (isNew) order.emplace_back(phase);
      EXPECT_GE(fraction, place->second) << nameOf(phase);
      EXPECT_LE(fraction, 1.0) << nameOf(phase);
      place->second = fraction;
    };
    Sphere().solve(job);
    ASSERT_EQ(order, (std::vector{Phase::kAssemble, Phase::kFactorise}));
    EXPECT_EQ(last[Phase::kAssemble], 1.0);
    EXPECT_EQ(last[Phase::kFactorise], 1.0);
  }
}

TEST(Job, StoppedBeforeTheStartDoesNothing) {
  std::stop_source source;
  source.request_stop();
  Job job;
  job.stop = source.get_token();
  int reports = 0;
  job.progress = [&](Phase, double) { ++reports; };
  EXPECT_THROW(Sphere().solve(job), Cancelled);
  EXPECT_EQ(reports, 0);
}

TEST(Job, StopsFromItsProgressCallbackInEveryPhase) {
  const Sphere sphere;
  for (const Phase wanted : {Phase::kAssemble, Phase::kFactorise}) {
    std::stop_source source;
    Job job;
    job.stop = source.get_token();
    std::optional<Phase> lastPhase;
    job.progress = [&](Phase phase, double) {
      lastPhase = phase;
      if (phase == wanted) source.request_stop();
    };
    EXPECT_THROW(sphere.solve(job), Cancelled) << nameOf(wanted);
    EXPECT_EQ(lastPhase, wanted);
  }
}

TEST(Job, ACancelledSolveCanBeRepeated) {
  const Sphere sphere;
  std::stop_source source;
  Job stopped;
  stopped.stop = source.get_token();
  stopped.progress = [&](Phase, double) { source.request_stop(); };
  EXPECT_THROW(sphere.solve(stopped), Cancelled);
  EXPECT_GT(sphere.solve(Job{})->conditionEstimate(), 1.0);
}

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> calls(1000);
    Job job;
    job.threads = threads;
    parallelFor(1000, job, [&](std::ptrdiff_t k) { ++calls[k]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
}

TEST(ParallelFor, PassesOnTheFirstExceptionAndStopsTheRest) {
  Job job;
  job.threads = 2;
  std::atomic<int> calls = 0;
  EXPECT_THROW(parallelFor(100000, job,
                           [&](std::ptrdiff_t k) {
                             ++calls;
                             if (k == 10) throw std::runtime_error("eleventh");
                           }),
               std::runtime_error);
  EXPECT_LT(calls, 100000);
}

TEST(ParallelFor, AcceptsZeroTasks) {
  parallelFor(0, Job{}, [](std::ptrdiff_t) { FAIL(); });
}

}  // namespace
}  // namespace palpa::bem

#include "app/core/results/refined_touch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "app/core/model/model_memory.h"
#include "app/core/results/finer_mesh.h"
#include "base/worker_thread.h"

namespace palpa::app {
namespace {

using End = RefinedTouch::End;
using Clock = std::chrono::steady_clock;

/// Elements are never more than halved: the error of a coarse mesh does not foretell much more.
constexpr double kMaxFactor = 2;
/// Lengths are divided by a little more than expected to be necessary.
constexpr double kMargin = 1.05;
/// An error that has grown foretells nothing.
constexpr double kFactorAfterGrowth = 1.3;
/// Lengths that differ by less may give the same mesh.
constexpr double kSmallFactor = 1.2;
/// A mesh whose number of coefficients grows by less shows nothing new.
constexpr double kMinGrowth = 1.05;
/// Curved bodies have a coarsest mesh, whatever the length of the elements.
constexpr double kFactorWithoutGrowth = 1.5, kMaxFactorWithoutGrowth = 16;
/// Growth of time and memory with the number of coefficients.
struct Growth {
  double time, memory;
};
/// Dense: the time is between assembly (2) and factorisation (3), and error estimates (1 to 1.5).
constexpr Growth kDense{2, 2};
/// Spheres of 5,000 to 50,000 nodes: 1.35 and 1.07 (docs/performance.md).
constexpr Growth kCompressed{1.5, 1.2};
/// A clock cannot add much more.
constexpr double kMaxSeconds = 1e8;

/// Cancels what has its token at a time, or with another token.
class Deadline {
 public:
  Deadline(const Clock::time_point& time, const std::stop_token& other)
      : withOther_(other, [this] { source_.request_stop(); }),
        timer_([this, time](const std::stop_token& end) {
          if (sleepUntil(time, end)) source_.request_stop();
        }) {}
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::stop_callback<std::function<void()>> withOther_;
  std::jthread timer_;  // last: it uses the source
};

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Chooses the next mesh from the former ones.
class NextMesh {
 public:
  NextMesh(const ErrorGoal& goal, const BuildOptions& options, Clock::time_point start)
      : goal_(goal), options_(options), start_(start) {}

  /// Settings of a finer mesh; otherwise the reason why there is none. Throws Cancelled.
  std::optional<modeling::MeshSettings> after(const RefinedTouch& touch, End& end,
                                              const Job& job) const {
    const RefinementStep& last = touch.steps.back();
    if (last.error <= goal_.error) return stop(End::kReached, end);
    if (static_cast<int>(touch.steps.size()) >= goal_.maxMeshes) return stop(End::kMeshes, end);
    const double usable = usableMemory(options_.memoryLimit);
    const double remaining = goal_.seconds - secondsSince(start_);
    if (remaining < last.seconds) return stop(End::kTime, end);
    const bool hasSplines = touch.model->setup().splines != nullptr;
    const bem::ProblemSize size = bem::sizeOf(*touch.model->setup().discretisation);
    const modeling::Engine engine = modeling::engineOf(touch.project);
    // Narrow parts have short edges already, and cells come in whole numbers, so the number of
    // nodes does not follow from the factor. Estimates have an error that both have in common.
    const double present = estimateCoefficients(touch.project, last.mesh, job);
    const auto growthOf = [&](double factor) {
      job.throwIfCancelled();
      return estimateCoefficients(touch.project, finerMesh(last.mesh, hasSplines, factor), job) /
             present;
    };
    end = End::kNoFiner;
    double factor = std::min(kMaxFactor, wishedFactor(touch.steps, hasSplines));
    double growth = growthOf(factor);
    while (growth < kMinGrowth && factor < kMaxFactorWithoutGrowth)
      growth = growthOf(factor *= kFactorWithoutGrowth);
    for (; growth >= kMinGrowth; growth = growthOf(factor = std::sqrt(factor))) {
      const Growth& power =
          choosesCompressed({growth * last.coefficients, growth * size.slots, size.thinShare},
                            engine, options_.compressedFrom)
              ? kCompressed
              : kDense;
      if (!(last.seconds * std::pow(growth, power.time) <= remaining))
        end = End::kTime;
      else if (usable > 0 && !(last.bytes * std::pow(growth, power.memory) <= usable))
        end = End::kMemory;
      else
        return finerMesh(last.mesh, hasSplines, factor);
      if (factor < kSmallFactor) break;
    }
    return std::nullopt;
  }

 private:
  static std::nullopt_t stop(End reason, End& end) {
    end = reason;
    return std::nullopt;
  }

  double wishedFactor(const std::vector<RefinementStep>& steps, bool hasSplines) const {
    const RefinementStep& last = steps.back();
    double order = usualOrder(hasSplines);
    if (steps.size() > 1) {
      const RefinementStep& former = steps[steps.size() - 2];
      if (last.error > former.error) return kFactorAfterGrowth;
      order = observedOrder(former.error, last.error,
                            refinement(former.mesh, last.mesh, hasSplines), hasSplines);
    }
    return std::max(kMargin * std::pow(last.error / goal_.error, 1 / order), kSmallFactor);
  }

  const ErrorGoal& goal_;
  const BuildOptions& options_;
  Clock::time_point start_;
};

RefinementStep stepOf(const modeling::Project& project, const TouchModel& model,
                      const TouchState& state, Clock::time_point begun) {
  return {project.mesh,
          model.report().nodes,
          static_cast<double>(model.setup().discretisation->displacementCount()),
          state.forceErrorEstimate.value_or(0),
          secondsSince(begun),
          model.report().memory};
}

}  // namespace

RefinedTouch refineTouch(const modeling::Project& project, const ErrorGoal& goal,
                         const BuildOptions& options, const PlayTouch& play, const Job& job) {
  const Clock::time_point start = Clock::now();
  const NextMesh next(goal, options, start);
  RefinedTouch touch;
  touch.project = project;
  touch.model = buildTouchModel(project, options, job);
  touch.state = play(*touch.model, project, job);
  touch.steps.push_back(stepOf(project, *touch.model, touch.state, start));
  const auto lifetime = std::chrono::duration<double>(std::min(goal.seconds, kMaxSeconds));
  const Deadline deadline(start + std::chrono::duration_cast<Clock::duration>(lifetime), job.stop);
  Job ofFiner = job;
  ofFiner.stop = deadline.token();
  while (const auto mesh = next.after(touch, touch.end, job)) {
    const Clock::time_point begun = Clock::now();
    modeling::Project finer = touch.project;
    finer.mesh = *mesh;
    std::shared_ptr<const TouchModel> model;
    TouchState state;
    try {
      model = buildTouchModel(finer, options, ofFiner);
      state = play(*model, finer, ofFiner);
    } catch (const Cancelled&) {
      job.throwIfCancelled();
      touch.end = End::kTime;
      return touch;
    } catch (const ModelTooLarge&) {
      touch.end = End::kMemory;
      return touch;
    } catch (const std::runtime_error& error) {  // of the modeller and of the solver
      touch.end = End::kFailed;
      touch.reason = error.what();
      return touch;
    }
    touch.steps.push_back(stepOf(finer, *model, state, begun));
    if (touch.steps.back().error >= touch.steps[touch.taken].error) continue;
    touch.model = std::move(model);
    touch.state = std::move(state);
    touch.project = std::move(finer);
    touch.taken = touch.steps.size() - 1;
  }
  return touch;
}

}  // namespace palpa::app

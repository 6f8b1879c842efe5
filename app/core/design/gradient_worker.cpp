#include "app/core/design/gradient_worker.h"

#include <chrono>
#include <utility>

#include "app/core/design/carried_stiffness.h"
#include "app/core/system/priority.h"
#include "base/error.h"

namespace palpa::app {

GradientWorker::GradientWorker(std::function<void(Result)> receive, int threads)
    : receive_(std::move(receive)), threads_(threads), worker_(lowerThreadPriority) {}

std::uint64_t GradientWorker::start(Request request) {
  const std::uint64_t number = ++number_;
  worker_.replace([this, number, request = std::move(request)](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    job.threads = threads_;
    run(number, request, job);
  });
  return number;
}

void GradientWorker::clear() {
  ++number_;
  worker_.replace([this](const std::stop_token&) { ofModel_ = {}; });
}

void GradientWorker::run(std::uint64_t number, const Request& request, const Job& job) {
  Result result;
  result.number = number;
  result.rule = request.rule;
  try {
    compute(request, job, result);
  } catch (const Cancelled&) {
    return;  // a newer request, or clear()
  } catch (const Error& error) {
    result.problem = error.what();
    receive_(std::move(result));
  }
}

void GradientWorker::compute(const Request& request, const Job& job, Result& result) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point began = Clock::now();
  const auto seconds = [began] {
    return std::chrono::duration<double>(Clock::now() - began).count();
  };
  const TouchModel& model = *request.model;
  if (ofModel_.model != request.model) {
    ofModel_ = {};
    ofModel_.model = request.model;
    ofModel_.surface = model.setup().discretisation->makeContactSurface(model.problem()->dofs());
  }
  if (request.from)
    result.rule = carriedRule(request.rule, *request.from, std::get<modeling::Solid>(model.body()));
  const ContactStiffness stiffness =
      contactStiffness(*model.problem(), *ofModel_.surface, result.rule, job);
  result.stiffness = stiffness.value;
  result.seconds = seconds();
  receive_(result);
  if (model.report().residual) return;
  if (!ofModel_.gradients)
    ofModel_.gradients = std::make_unique<StiffnessGradients>(*request.project, model, job);
  result.gradient = ofModel_.gradients->gradient(stiffness, job);
  if (request.drawn) {
    if (ofModel_.drawn != request.drawn) {
      ofModel_.onSurface =
          std::make_unique<SurfaceGradient>(ofModel_.gradients->surface(), *request.drawn);
      ofModel_.drawn = request.drawn;
    }
    result.surface = ofModel_.onSurface->values(result.gradient);
  }
  result.seconds = seconds();
  receive_(std::move(result));
}

}  // namespace palpa::app

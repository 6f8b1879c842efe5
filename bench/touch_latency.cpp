#include "bench/touch_latency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>
#include <utility>

#include "app/core/live/touch_field.h"
#include "bench/sphere.h"

namespace palpa::bench {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using Clock = std::chrono::steady_clock;
using Kind = bem::ContactTool::Kind;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Waits until a loop touches a model.
void begin(app::TouchLoop& loop, const std::shared_ptr<const app::TouchModel>& model) {
  const auto number = loop.setModel(model);
  app::TouchSnapshot snapshot;
  while (loop.read(snapshot), snapshot.model != number) std::this_thread::sleep_for(1ms);
}

/// Waits for the first force of a contact.
Clock::time_point timeOfForce(const app::TouchLoop& loop, app::TouchId id) {
  app::TouchSnapshot snapshot;
  do {
    std::this_thread::sleep_for(200us);
    loop.read(snapshot);
  } while (!snapshot.find(id) || snapshot.find(id)->force.isZero(0));
  return snapshot.time;
}

/// The work of a window while the loop runs.
int display(const app::TouchLoop& loop, const std::stop_token& stop) {
  app::TouchSnapshot snapshot;
  std::unique_ptr<app::TouchField> field;
  int count = 0;
  while (!stop.stop_requested()) {
    loop.read(snapshot);
    if (const auto body = loop.model(snapshot.model)) {
      if (!field || field->model() != body) field = std::make_unique<app::TouchField>(body);
      field->describe(snapshot);
      ++count;
    }
    std::this_thread::sleep_for(16ms);
  }
  return count;
}

}  // namespace

LatencyReport measureLatency(const std::shared_ptr<const app::TouchModel>& model, int contacts,
                             std::chrono::duration<double> duration, bool computesAll) {
  app::TouchLoop::Options options;
  options.computesAll = computesAll;
  app::TouchLoop loop(options);
  begin(loop, model);
  LatencyReport report;
  const auto touched = Clock::now();
  app::TouchId last = 0;
  const std::vector<Vector3d> points = pointsOnSphere(contacts);
  for (std::size_t k = 0; k < points.size(); ++k) {
    last = loop.begin({Kind::kGrab, 3}, points[k], -0.02 * points[k]);
    if (k > 0) continue;
    report.firstForce = secondsBetween(touched, timeOfForce(loop, last));
  }
  app::TouchSnapshot snapshot;
  const auto isTouching = [&] {
    loop.read(snapshot);
    return snapshot.contactCount == contacts &&
           std::ranges::none_of(snapshot.touched(),
                                [](const auto& contact) { return contact.force.isZero(0); });
  };
  while (!isTouching()) std::this_thread::sleep_for(1ms);

  int displayed = 0;
  {
    const std::jthread window(
        [&](const std::stop_token& stop) { displayed = display(loop, stop); });
    std::mt19937 random(1);
    std::uniform_real_distribution<double> pause(0.5e-3, 3e-3);
    std::vector<double> latencies;
    loop.read(snapshot);
    const std::uint64_t firstStep = snapshot.step;
    const auto start = Clock::now();
    loop.clearLatency();
    for (int k = 1; Clock::now() - start < duration; ++k) {
      const Vector3d value(0, 0, 1e-4 * (k % 10'000));
      const auto said = Clock::now();
      loop.set(last, value);
      do {
        std::this_thread::sleep_for(50us);
        loop.read(snapshot);
      } while (snapshot.find(last)->value != value);
      latencies.push_back(secondsBetween(said, Clock::now()));
      std::this_thread::sleep_for(std::chrono::duration<double>(pause(random)));
      loop.read(snapshot);
    }
    report.inside = loop.latencies();
    report.rate =
        static_cast<double>(snapshot.step - firstStep) / secondsBetween(start, snapshot.time);
    report.latency = quantilesOf(std::move(latencies));
  }
  report.displayed = displayed;
  report.columnsReady = snapshot.columnsReady;
  return report;
}

NewPlaces touchNewPlaces(const std::shared_ptr<const app::TouchModel>& model,
                         const bem::ContactTool& tool, int places, Eigen::Index answersPlacesFrom) {
  constexpr std::chrono::seconds kSettling{10};
  constexpr double kSettled = 0.01, kDepth = 0.04;  // relative to the force and the radius
  app::TouchLoop::Options options;
  options.answersPlacesFrom = answersPlacesFrom;
  app::TouchLoop loop(options);
  begin(loop, model);
  NewPlaces times;
  for (const Vector3d& at : pointsOnSphere(places)) {
    std::this_thread::sleep_for(500ms);  // columns of other places have begun
    const Vector3d value = tool.kind == Kind::kBall
                               ? Vector3d((1 - kDepth + tool.radius / at.norm()) * at)
                               : Vector3d(-kDepth * at);
    const auto touched = Clock::now();
    const app::TouchId id = loop.begin(tool, at, value);
    times.first.push_back(secondsBetween(touched, timeOfForce(loop, id)));
    std::vector<std::pair<double, Vector3d>> forces;
    app::TouchSnapshot snapshot;
    do {
      loop.read(snapshot);
      forces.emplace_back(secondsBetween(touched, snapshot.time), snapshot.find(id)->force);
      std::this_thread::sleep_for(5ms);
    } while (snapshot.time - touched < kSettling);
    const Vector3d last = forces.back().second;
    const auto differing = std::find_if(forces.rbegin(), forces.rend(), [&](const auto& each) {
      return (each.second - last).norm() > kSettled * last.norm();
    });
    times.settled.push_back(differing == forces.rend() ? times.first.back() : differing->first);
    loop.end(id);
  }
  return times;
}

}  // namespace palpa::bench

#include "bench/touch_slide.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace palpa::bench {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 25, kTilt = std::numbers::pi / 6, kStep = 0.1;  // mm, rad, mm

}  // namespace

double Slide::largestForce() const {
  double largest = 0;
  for (const Sample& sample : samples) largest = std::max(largest, sample.force.norm());
  return largest;
}

double Slide::largestJump() const {
  double largest = 0;
  for (std::size_t k = kOnset; k < samples.size(); ++k)
    largest = std::max(largest, (samples[k].force - samples[k - 1].force).norm());
  return largest;
}

double Slide::largestMagnitudeJump() const {
  double largest = 0;
  for (std::size_t k = kOnset; k < samples.size(); ++k)
    largest = std::max(largest, std::abs(samples[k].force.norm() - samples[k - 1].force.norm()));
  return largest;
}

double Slide::largestKink() const {
  double largest = 0;
  for (std::size_t k = kOnset; k + 1 < samples.size(); ++k)
    largest = std::max(largest, std::abs(samples[k + 1].force.norm() - 2 * samples[k].force.norm() +
                                         samples[k - 1].force.norm()));
  return largest;
}

Slide dragAround(const std::shared_ptr<const app::TouchableModel>& model,
                 const bem::ContactTool& tool, double depth) {
  using Clock = std::chrono::steady_clock;
  const double distance =
      kRadius - depth + (tool.kind == bem::ContactTool::Kind::kBall ? tool.radius : 0);
  const auto direction = [](double angle) {
    return Vector3d(std::cos(angle), std::sin(angle) * std::cos(kTilt),
                    std::sin(angle) * std::sin(kTilt));
  };
  bem::ContactSimulation simulation = model->simulate();
  const auto id = simulation.begin(tool, kRadius * direction(0), distance * direction(0));
  const auto prepare = [&] {
    while (!simulation.missing().empty()) model->columns()->compute(simulation.missing(), {});
  };
  for (int settling = 0; settling < 20; ++settling) {
    prepare();
    simulation.step();
  }
  Slide slide;
  const int steps = static_cast<int>(2 * std::numbers::pi * kRadius / kStep);
  for (int k = 0; k <= steps; ++k) {
    const double angle = 2 * std::numbers::pi * k / steps;
    simulation.set(id, distance * direction(angle));
    prepare();
    const auto start = Clock::now();
    simulation.step();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const auto& contact = *simulation.find(id);
    slide.samples.push_back({angle, contact.force, seconds, simulation.converged(),
                             static_cast<int>(contact.patch.size()),
                             contact.patch.empty() ? 0 : contact.patch.front().radius});
  }
  return slide;
}

}  // namespace palpa::bench

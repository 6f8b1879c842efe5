#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "app/core/live/touch_loop.h"
#include "app/core/model/build_touch_model.h"
#include "core_projects.h"

// A sphere for touch loops, and what tests wait for.

namespace palpa::app::test {

inline const Eigen::Vector3d kTop(0, 0, 25), kSide(25, 0, 0);

inline std::shared_ptr<const TouchModel> build(const modeling::Project& project) {
  return buildTouchModel(project, {}, {});
}

inline const std::shared_ptr<const TouchModel>& sphere() {
  static const auto shared = build(clampedSphere(6));
  return shared;
}

/// The same sphere a little larger.
inline std::shared_ptr<const TouchModel> largerSphere(double factor) {
  modeling::Project project = clampedSphere(6);
  auto& solid = std::get<modeling::Solid>(project.body);
  std::vector<Eigen::Vector3d> points = solid.controlPoints();
  for (Eigen::Vector3d& point : points) point *= factor;
  project.body = solid.withControlPoints(std::move(points));
  return build(project);
}

/// Waits until the snapshots of a loop fulfil a condition; fails after a minute.
inline TouchSnapshot await(const TouchLoop& loop,
                           const std::function<bool(const TouchSnapshot&)>& condition) {
  TouchSnapshot snapshot;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  do {
    loop.read(snapshot);
    if (condition(snapshot)) return snapshot;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  } while (std::chrono::steady_clock::now() < end);
  const auto status = loop.status();
  ADD_FAILURE() << "waited for a minute; model " << snapshot.model << " of " << status.newest
                << " (prepared " << status.prepared << "), step " << snapshot.step << ", "
                << snapshot.contactCount << " contacts, residual " << snapshot.residual
                << ", converged " << snapshot.isConverged << ", columns " << snapshot.columnsReady
                << ", error \"" << status.error << "\"";
  return snapshot;
}

inline auto hasForce(TouchId id) {
  return [id](const TouchSnapshot& snapshot) {
    const auto* contact = snapshot.find(id);
    return contact && contact->force.norm() > 0;
  };
}

/// Has a step been made with this value?
inline auto hasValue(TouchId id, const Eigen::Vector3d& value) {
  return [id, value](const TouchSnapshot& snapshot) {
    const auto* contact = snapshot.find(id);
    return contact && contact->value == value && contact->status != TouchSnapshot::Status::kWaiting;
  };
}

inline auto stepsAfter(std::uint64_t step) {
  return [step](const TouchSnapshot& snapshot) { return snapshot.step >= step; };
}

inline auto isComplete(std::uint64_t model) {
  return [model](const TouchSnapshot& snapshot) {
    return snapshot.model == model && snapshot.columnsReady == 1;
  };
}

}  // namespace palpa::app::test

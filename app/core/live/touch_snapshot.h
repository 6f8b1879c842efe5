#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <span>

#include "app/core/live/touch_command.h"

namespace palpa::app {

/// Figures of a snapshot that concern all contacts together.
struct TouchSummary {
  std::uint64_t model = 0;  ///< TouchLoop::setModel()'s number of the model touched; 0: none
  std::uint64_t step = 0;   ///< number of steps so far
  std::chrono::steady_clock::time_point time;
  /// True if the last step met all laws of contact. See bem::ContactSimulation::converged().
  bool isConverged = true;
  double residual = 0;      ///< of the laws, relative
  double columnsReady = 0;  ///< of the model's Green's function, 0 … 1
  double rate = 0;          ///< steps per second, over about the last quarter of a second
  int contactCount = 0, patchCount = 0;
};

/// The state of all contacts after one step; of fixed size, so that it is handed over without
/// allocation. Copying copies only the used part.
struct TouchSnapshot : TouchSummary {
  static constexpr int kMaxContacts = 64;
  static constexpr int kMaxBalls = 8;  ///< of these, as each has many masks
  static constexpr int kMaxPatches = kMaxContacts + kMaxBalls * bem::ContactTool::kBallMasks;

  using Status = bem::ContactSimulation::Status;
  using Patch = bem::ContactSimulation::PatchForce;
  struct Contact {
    TouchId id = 0;
    bem::ContactTool tool{};
    Status status = Status::kWaiting;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< as given to begin() or set()
    bem::SurfacePoint point{};                        ///< on the unloaded shape
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N, on the body
    // See ContactSimulation::Contact.
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< mm, at the middle
    Eigen::Vector3d deflection = Eigen::Vector3d::Zero();    ///< mm, part of the displacement
    double stiffness = 0;                                    ///< N/mm
    double normalCompliance = 0;                             ///< mm/N
    int firstPatch = 0, patchCount = 0;
  };
  std::array<Contact, kMaxContacts> contacts{};
  std::array<Patch, kMaxPatches> patches{};

  std::span<const Contact> touched() const {
    return std::span(contacts).first(static_cast<std::size_t>(contactCount));
  }
  /// The masks of all contacts that carry force.
  std::span<const Patch> pressed() const {
    return std::span(patches).first(static_cast<std::size_t>(patchCount));
  }
  std::span<const Patch> pressed(const Contact& contact) const {
    return pressed().subspan(static_cast<std::size_t>(contact.firstPatch),
                             static_cast<std::size_t>(contact.patchCount));
  }
  /// Null without such a contact.
  const Contact* find(TouchId id) const {
    const auto all = touched();
    const auto place = std::find_if(all.begin(), all.end(),
                                    [id](const Contact& contact) { return contact.id == id; });
    return place == all.end() ? nullptr : &*place;
  }

  TouchSnapshot() = default;
  TouchSnapshot(const TouchSnapshot& other) : TouchSnapshot() { *this = other; }
  TouchSnapshot& operator=(const TouchSnapshot& other) {
    if (this == &other) return *this;
    static_cast<TouchSummary&>(*this) = other;
    std::copy_n(other.contacts.begin(), contactCount, contacts.begin());
    std::copy_n(other.patches.begin(), patchCount, patches.begin());
    return *this;
  }
};

}  // namespace palpa::app

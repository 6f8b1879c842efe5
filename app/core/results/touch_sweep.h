#pragma once

#include <functional>
#include <ostream>
#include <span>
#include <vector>

#include "app/core/model/touch_model.h"
#include "base/job.h"

namespace palpa::app {

/// Largest number of steps of a sweep.
inline constexpr int kMaxSweepSteps = 1000;

/// One state of a sweep.
struct SweepRow {
  double share = 0;  ///< of the touches' displacements and forces, 0 … 1
  std::vector<modeling::Touch> touches;
  std::vector<TouchState::Contact> contacts;  ///< one per touch
  double energy = 0;                          ///< strain energy, mJ
};

/// The touches with `share` of their displacements and forces.
std::vector<modeling::Touch> scaled(std::span<const modeling::Touch> touches, double share);

/// Plays touches at the shares 0, 1/count, …, 1 of their displacements and forces: force-depth
/// curves. Each state equals playTouches() of the scaled touches bit for bit: pushes and balls
/// start at first contact again, so every state is one of loading. `seen` gets the states in this
/// order. `steps`: of playTouches(). Throws as playTouches(); std::invalid_argument for a count
/// outside 1 … kMaxSweepSteps.
void sweepTouches(const TouchModel& model, std::span<const modeling::Touch> touches, int count,
                  int steps, const Job& job, const std::function<void(SweepRow)>& seen);

/// Writes a sweep as comma-separated values: a line of names with units, then a line for every
/// touch of every state, numbers with all their digits. `given`: length of the displacement (mm) or
/// force (N) that the touch prescribes.
void writeSweep(std::span<const SweepRow> rows, std::ostream& out);

}  // namespace palpa::app

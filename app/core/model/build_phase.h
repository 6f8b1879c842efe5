#pragma once

#include <algorithm>
#include <array>
#include <cassert>

#include "base/phase.h"

namespace palpa::app {

/// A phase of buildTouchModel() or updateTouchModel().
struct BuildPhase {
  Phase phase;
  const char* label;  ///< for users, in English
  double seconds;     ///< measured for a sphere of 2,500 nodes; see BuildProgress
};

/// In the order in which a build goes through them. An update precedes a full rebuild; a stored
/// model is read instead of being assembled and factorised.
inline constexpr std::array kBuildPhases{
    BuildPhase{Phase::kUpdate, "Update the model", 0.3},
    BuildPhase{Phase::kMesh, "Mesh", 0.3},
    BuildPhase{Phase::kCheck, "Check the surface", 0.1},
    BuildPhase{Phase::kSetup, "Set up supports and loads", 0.1},
    BuildPhase{Phase::kRead, "Read the stored model", 0.3},
    BuildPhase{Phase::kAssemble, "Assemble", 2.0},
    BuildPhase{Phase::kFactorise, "Factorise", 2.0},
    BuildPhase{Phase::kSolve, "Solve", 0.2}};

/// Progress over all phases of a build, 0 … 1. The share of a phase is the time that it took in the
/// last build, by default BuildPhase::seconds.
class BuildProgress {
 public:
  BuildProgress() {
    for (std::size_t i = 0; i < kBuildPhases.size(); ++i) seconds_[i] = kBuildPhases[i].seconds;
  }

  /// The phase took this time in a complete build. A minimum keeps phases visible that took no
  /// time.
  void learn(Phase phase, double seconds) {
    constexpr double kLeast = 1e-3;
    seconds_[indexOf(phase)] = std::max(seconds, kLeast);
  }

  /// Begins another build.
  void restart() { isUpdating_ = isReading_ = false; }

  /// Progress after the done fraction of a phase, which must be in kBuildPhases. Never falls
  /// between two calls of restart().
  double at(Phase phase, double fraction) {
    isUpdating_ = isUpdating_ || phase == Phase::kUpdate;
    isReading_ = isReading_ || phase == Phase::kRead;
    const std::size_t present = indexOf(phase);
    double before = 0, total = 0;
    for (std::size_t i = 0; i < kBuildPhases.size(); ++i) {
      if (!isOnPath(kBuildPhases[i].phase)) continue;
      total += seconds_[i];
      if (i < present) before += seconds_[i];
    }
    return (before + fraction * seconds_[present]) / total;
  }

 private:
  static std::size_t indexOf(Phase phase) {
    const auto* const found =
        std::find_if(kBuildPhases.begin(), kBuildPhases.end(),
                     [phase](const auto& each) { return each.phase == phase; });
    assert(found != kBuildPhases.end());
    return static_cast<std::size_t>(found - kBuildPhases.begin());
  }
  bool isOnPath(Phase phase) const {
    if (phase == Phase::kUpdate) return isUpdating_;
    if (phase == Phase::kRead) return isReading_;
    return !isReading_ || (phase != Phase::kAssemble && phase != Phase::kFactorise);
  }

  std::array<double, kBuildPhases.size()> seconds_{};
  bool isUpdating_ = false, isReading_ = false;
};

}  // namespace palpa::app

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
  double begin, end;  ///< share of the progress of a build, for bodies of some thousand nodes
};

/// In the order in which a build goes through them. An update precedes a full rebuild; a stored
/// model is read instead of being assembled and factorised.
inline constexpr std::array kBuildPhases{
    BuildPhase{Phase::kUpdate, "Update the model", 0, 0.04},
    BuildPhase{Phase::kMesh, "Mesh", 0, 0.04},
    BuildPhase{Phase::kCheck, "Check the surface", 0.04, 0.07},
    BuildPhase{Phase::kSetup, "Set up supports and loads", 0.07, 0.08},
    BuildPhase{Phase::kRead, "Read the stored model", 0.08, 0.9},
    BuildPhase{Phase::kAssemble, "Assemble", 0.08, 0.45},
    BuildPhase{Phase::kFactorise, "Factorise", 0.45, 0.9},
    BuildPhase{Phase::kSolve, "Solve", 0.9, 1}};

/// Progress over all phases, 0 … 1. `phase` must be in kBuildPhases.
constexpr double buildProgress(Phase phase, double fraction) {
  const auto* const found = std::find_if(kBuildPhases.begin(), kBuildPhases.end(),
                                         [phase](const auto& each) { return each.phase == phase; });
  assert(found != kBuildPhases.end());
  return found == kBuildPhases.end() ? 0 : found->begin + fraction * (found->end - found->begin);
}

}  // namespace palpa::app

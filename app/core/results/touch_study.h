#pragma once

#include <memory>
#include <vector>

#include "app/core/model/touch_model.h"
#include "base/job.h"

namespace palpa::app {

/// The states of a project that a report is about, all with their estimated errors: what `solve`
/// and `touch` of the command line compute.
struct TouchStudy {
  modeling::Project project;
  std::shared_ptr<const TouchModel> model;
  TouchState rest;  ///< without touches
  /// All touches at the same time; without contacts if the project has none.
  TouchState together;
  /// One touch alone.
  struct Single {
    std::size_t touch = 0;  ///< its index in the project
    TouchState state;
  };
  /// Every touch alone, in the order of the project, without those that exert no force alone
  /// (isPassive()). Empty if the project has less than two touches.
  std::vector<Single> alone;

  /// The states in which one touch or all touches act: `alone`, or `together` of a single touch.
  const TouchState& ofTouch(std::size_t single) const {
    return alone.empty() ? together : alone[single].state;
  }
};

/// True for a touch that holds its place where the other touches and the loads leave it.
bool isPassive(const modeling::Touch& touch);

/// Plays the touches of a project together and alone, and estimates the errors. `model`: of the
/// project; null: built here. Costs an assembly per state, besides the build.
///
/// Phases of progress: the phases of buildTouchModel(), "touch", "estimate errors". Throws as
/// buildTouchModel() and playTouches(), with the name of a touch that cannot be played alone;
/// Cancelled.
TouchStudy makeTouchStudy(const modeling::Project& project, std::shared_ptr<const TouchModel> model,
                          const Job& job);

}  // namespace palpa::app

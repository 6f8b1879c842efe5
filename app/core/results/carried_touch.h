#pragma once

#include <span>
#include <vector>

#include "app/core/model/touch_model.h"
#include "bem/contact/contact_surface.h"

namespace palpa::app {

class TouchPlayer;

/// A touch on another body than the one it was made for.
struct CarriedTouch {
  modeling::Touch touch;
  double distance = 0;    ///< mm, from the former place to the present one
  bool isTurned = false;  ///< the surface there faces away from the former side
};

/// The same touches on another body: same tool, displacement or force and friction, at the point of
/// the surface of `to` nearest to each place. A touch without a radius gets the default radius of
/// `from`, so that both bodies meet the same tool.
std::vector<CarriedTouch> carryTouches(std::span<const modeling::Touch> touches,
                                       const TouchModel& from, const TouchModel& to);

/// A contact of the touch loop, as TouchSnapshot::Contact describes it.
struct LiveContact {
  std::string name;
  bem::ContactTool tool;
  Eigen::Vector3d at;     ///< mm, where it began on the unloaded shape
  Eigen::Vector3d value;  ///< see bem::ContactSimulation::begin()
};

/// Touches that lead straight from first contact to the present values of contacts. For grabs,
/// forces and tools that moved straight, TouchPlayer::play() reaches the forces of the loop; the
/// friction of other paths is left out. `surface`: of the model that `player` plays on. Throws as
/// TouchPlayer::play().
std::vector<modeling::Touch> touchesOf(std::span<const LiveContact> contacts,
                                       const bem::ContactSurface& surface, TouchPlayer& player,
                                       const Job& job);

}  // namespace palpa::app

#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/core/live/touch_loop.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {

/// A place of a body's surface.
struct Place {
  Eigen::Vector3d at, normal;  ///< mm; outward, unit
};
/// The nodes of a model's mesh.
std::vector<Place> placesOf(const app::TouchModel& model);

/// Touches a body at random: begins, moves and ends contacts of every kind, several at once.
/// One thread per hand.
class Hand {
 public:
  Hand(app::TouchLoop& loop, std::uint64_t seed, int most)
      : loop_(loop), random_(seed), most_(most) {}

  /// Does one random thing.
  void act(const std::vector<Place>& places);
  void letGoOfAll();
  /// What was done so far.
  long begun() const { return begun_; }
  long moved() const { return moved_; }
  long refused() const { return refused_; }

 private:
  struct Held {
    app::TouchId id;
    bem::ContactTool tool;
    Place place;
  };
  void begin(const std::vector<Place>& places);
  /// A value within a millimetre or two of where the contact began.
  Eigen::Vector3d valueOf(const Held& held);

  app::TouchLoop& loop_;
  Random random_;
  int most_;
  std::vector<Held> held_;
  long begun_ = 0, moved_ = 0, refused_ = 0;
};

}  // namespace palpa::reliability

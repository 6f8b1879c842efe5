#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/core/live/touch_loop.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {

/// A place on a body's surface.
struct Place {
  Eigen::Vector3d at, normal;  ///< mm; outward, unit
};
/// The nodes of a model's mesh.
std::vector<Place> placesOf(const app::TouchModel& model);

/// Touches a body at random: begins, moves and ends contacts of every kind, several at a time.
/// Each user needs one thread.
class TouchUser {
 public:
  TouchUser(app::TouchLoop& loop, std::uint64_t seed, int maxContacts)
      : loop_(loop), random_(seed), maxContacts_(maxContacts) {}

  /// Performs one random action.
  void act(const std::vector<Place>& places);
  void endAll();
  // Numbers of actions so far.
  long begun() const { return begun_; }
  long moved() const { return moved_; }
  long refused() const { return refused_; }

 private:
  struct Contact {
    app::TouchId id;
    bem::ContactTool tool;
    Place place;
  };
  void begin(const std::vector<Place>& places);
  /// A value within one or two millimetres of the contact's beginning.
  Eigen::Vector3d valueOf(const Contact& contact);

  app::TouchLoop& loop_;
  Random random_;
  int maxContacts_;
  std::vector<Contact> contacts_;
  long begun_ = 0, moved_ = 0, refused_ = 0;
};

}  // namespace palpa::reliability

#include "app/core/design/target_values.h"

#include <algorithm>

#include "app/core/results/touch.h"

namespace palpa::app {
namespace {

using modeling::DesignTarget;

/// All touches of a project together, one of them at another depth.
struct Play {
  std::string touch;  ///< empty: all as stored
  double depth = 0;   ///< mm
  bool operator==(const Play&) const = default;
};

Play playOf(const DesignTarget& target, const modeling::Project& project) {
  const auto touch =
      std::find_if(project.touches.begin(), project.touches.end(),
                   [&](const modeling::Touch& each) { return each.name == target.touch; });
  if (!target.depth || *target.depth == touch->vector.norm()) return {};
  return {target.touch, *target.depth};
}

}  // namespace

std::vector<TargetValue> targetValues(const modeling::Project& project, const TouchModel& model,
                                      const std::vector<DesignTarget>& targets, const Job& job) {
  std::vector<Play> plays;
  std::vector<TouchState> played;
  std::vector<TargetValue> values;
  for (const DesignTarget& target : targets) {
    const Play play = playOf(target, project);
    const auto index =
        static_cast<std::size_t>(std::find(plays.begin(), plays.end(), play) - plays.begin());
    if (index == plays.size()) {
      std::vector<modeling::Touch> touches = project.touches;
      for (modeling::Touch& touch : touches)
        if (!play.touch.empty() && touch.name == play.touch)
          touch.vector *= play.depth / touch.vector.norm();
      plays.push_back(play);
      played.push_back(playTouches(model, touches, 0, job));
    }
    const std::vector<TouchState::Contact>& contacts = played[index].contacts;
    const auto contact = std::find_if(contacts.begin(), contacts.end(),
                                      [&](const auto& each) { return each.name == target.touch; });
    const double value =
        target.kind == DesignTarget::Kind::kStiffness ? contact->stiffness : contact->force.norm();
    values.push_back({value, *contact});
  }
  return values;
}

}  // namespace palpa::app

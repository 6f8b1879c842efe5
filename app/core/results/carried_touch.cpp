#include "app/core/results/carried_touch.h"

#include "app/core/model/contact_kind.h"
#include "app/core/results/tool_trajectory.h"
#include "app/core/results/touch.h"

namespace palpa::app {

std::vector<CarriedTouch> carryTouches(std::span<const modeling::Touch> touches,
                                       const TouchModel& from, const TouchModel& to) {
  const bem::BoundaryMesh& former = from.setup().mesh();
  const bem::BoundaryMesh& present = to.setup().mesh();
  std::vector<CarriedTouch> result;
  for (const modeling::Touch& touch : touches) {
    const bem::SurfacePoint before = bem::nearestSurfacePoint(former, touch.at);
    const bem::SurfacePoint now = bem::nearestSurfacePoint(present, touch.at);
    CarriedTouch carried{touch, now.distance,
                         former.normal(before.triangle).dot(present.normal(now.triangle)) < 0};
    carried.touch.at = now.position;
    if (!touch.radius) carried.touch.radius = defaultTouchRadius(former);
    result.push_back(std::move(carried));
  }
  return result;
}

std::vector<modeling::Touch> touchesOf(std::span<const LiveContact> contacts,
                                       const bem::ContactSurface& surface, TouchPlayer& player,
                                       const Job& job) {
  std::vector<modeling::Touch> touches, statics;
  for (const LiveContact& contact : contacts) {
    modeling::Touch touch{
        contact.name,  contact.at,          touchKindOf(contact.tool.kind),
        contact.value, contact.tool.radius, contact.tool.presses() ? contact.tool.friction : 0};
    if (!contact.tool.presses()) statics.push_back(touch);
    touches.push_back(std::move(touch));
  }
  if (statics.size() == touches.size()) return touches;
  // Tools start at first contact with the surface that loads and static contacts displace.
  const TouchState before = player.play(statics, 0, job);
  for (std::size_t k = 0; k < touches.size(); ++k)
    if (contacts[k].tool.presses())
      touches[k].vector -=
          toolAtFirstContact(surface, contacts[k].tool, contacts[k].at, before.field);
  return touches;
}

}  // namespace palpa::app

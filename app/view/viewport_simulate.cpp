#include <cmath>
#include <stdexcept>
#include <string>

#include "app/view/viewport_parts.h"

namespace palpa::view {
namespace {

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("viewport: ") + message);
}

}  // namespace

void Viewport::setField(const std::optional<ScalarField>& field) {
  if (field)
    require(field->values.size() == parts_->body.positions.size(),
            "a field needs one number per point");
}

void Viewport::setFieldValues(const std::vector<double>& values, const std::array<double, 2>&) {
  require(values.size() == parts_->body.positions.size(), "a field needs one number per point");
}

void Viewport::setGhost(const std::optional<ViewportBody>&) {}

void Viewport::setLiveArrows(const LiveArrows& arrows) {
  require(arrows.fullForce > 0, "the full force is positive");
}

void Viewport::setContactRings(const std::vector<ContactRing>&) {}

void Viewport::setProbeBalls(const std::vector<ProbeBall>& balls) {
  for (const ProbeBall& ball : balls) require(ball.radius > 0, "the radius of a ball is positive");
}

}  // namespace palpa::view

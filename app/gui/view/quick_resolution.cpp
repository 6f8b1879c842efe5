#include "app/gui/view/quick_resolution.h"

#include <array>

namespace palpa::gui {
namespace {

/// Of the time of a picture, what does not depend on the number of its pixels.
constexpr double kFixedPart = 0.2;
constexpr double kMemory = 0.75;  // of the estimate, per picture

struct Step {
  double share;
  double longest;  ///< ms of a picture with all pixels, up to which this share is fine enough
};
/// 33 ms pass from picture to picture at 30 per second, and the window's other parts need some.
constexpr std::array<Step, 3> kSteps{{{1, 21}, {0.7, 40}, {0.5, 1e9}}};
/// A picture with more pixels must be this much faster than needed, so that shares do not
/// alternate.
constexpr double kMargin = 0.75;

}  // namespace

void QuickResolution::drawn(double milliseconds) {
  if (isFirst_) {
    isFirst_ = false;
    return;
  }
  const double full = milliseconds / (kFixedPart + (1 - kFixedPart) * share_ * share_);
  full_ = full_ == 0 ? full : kMemory * full_ + (1 - kMemory) * full;
  for (const Step& step : kSteps) {
    if (full_ > step.longest * (step.share > share_ ? kMargin : 1)) continue;
    isFirst_ = step.share != share_;
    share_ = step.share;
    return;
  }
}

}  // namespace palpa::gui

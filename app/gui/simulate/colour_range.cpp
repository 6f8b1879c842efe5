#include "app/gui/simulate/colour_range.h"

#include <algorithm>

#include "base/round_number.h"

namespace palpa::gui {
namespace {

constexpr double kHeadroom = 0.25;  // a range is reduced if the values fill less than this share

}  // namespace

std::array<double, 2> ColourRange::roundRange(double largest, bool isSymmetric) {
  const double end = roundedUp(largest);
  return {isSymmetric ? -end : 0, end};
}

void ColourRange::setMode(Mode mode, const std::array<double, 2>& manual) {
  mode_ = mode;
  manual_ = manual;
  if (mode != Mode::kHold) restart();
}

void ColourRange::startField() {
  restart();
  largestInside_ = largestBeside_ = 0;
  if (mode_ == Mode::kHold) mode_ = Mode::kAutomatic;
}

void ColourRange::update(double largest, double least, bool isSigned) {
  if (mode_ == Mode::kManual) {
    ends_ = manual_;
    return;
  }
  const double present = ends_[1];
  if (mode_ == Mode::kHold && present != 0) return;
  largest = std::max({largest, largestInside_, largestBeside_});
  // Change the range rarely, so that colours can be compared over time.
  if (present == 0 || largest > present || (largest > 0 && largest < kHeadroom * present))
    ends_[1] = roundedUp(std::max(largest, least));
  ends_[0] = isSigned || mode_ == Mode::kSymmetric ? -ends_[1] : 0;
}

}  // namespace palpa::gui

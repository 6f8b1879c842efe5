#include "app/view/layers/warning_signs.h"

#include <algorithm>
#include <cmath>

#include "app/view/layers/text.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kSign = 20;   // width and height of the triangle
constexpr double kStem = 26;   // from the place up to the plate
constexpr double kPlate = 28;  // height of the plate
constexpr double kPad = 7;

struct Box {
  Eigen::Vector2d low, high;

  bool overlaps(const Box& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

/// A triangle with an exclamation mark, centred.
void addSign(const Eigen::Vector2d& center, double pixel, const Colour& colour,
             FlatShapes& shapes) {
  const double h = 0.5 * kSign * pixel;
  const Colour white{1, 1, 1};
  const auto at = [&](double x, double y) {
    return Eigen::Vector2d(center + h * Eigen::Vector2d(x, y));
  };
  shapes.addPolygon({at(-0.10, -0.92), at(0.10, -0.92), at(1.02, 0.70), at(0.94, 0.86),
                     at(-0.94, 0.86), at(-1.02, 0.70)},
                    colour);
  shapes.addPolygon({at(-0.13, -0.42), at(0.13, -0.42), at(0.08, 0.26), at(-0.08, 0.26)}, white);
  shapes.addDisc(at(0, 0.52), 0.13 * h, white);
}

}  // namespace

WarningSigns::WarningSigns(vtkRenderer* overlay) : overlay_(overlay) {}

void WarningSigns::set(const std::vector<WarningMarker>& warnings, const ViewportTheme& theme,
                       double pixelRatio) {
  for (const Sign& sign : signs_) {
    if (sign.text) overlay_->RemoveActor2D(sign.text);
  }
  signs_.clear();
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  for (const WarningMarker& warning : warnings) {
    Sign sign{warning.at, nullptr, Eigen::Vector2d::Zero()};
    if (!warning.text.empty()) {
      sign.text = makeText(warning.text, {kFontSize * pixelRatio, false, theme.text});
      sign.size = textSize(sign.text, overlay_);
      overlay_->AddActor2D(sign.text);
    }
    signs_.push_back(sign);
  }
}

void WarningSigns::update(const Turntable& camera, FlatShapes& shapes) {
  std::vector<Box> taken;
  for (const Sign& sign : signs_) {
    const Eigen::Vector2d place = camera.toPixel(sign.at);
    const bool visible = visible_ && place.allFinite();
    if (sign.text) sign.text->SetVisibility(visible);
    if (!visible) continue;
    // The sign stands above its place, all of it in the picture; the text on the side where there
    // is room.
    const double half = 0.5 * kPlate * pixelRatio_;
    const double textWidth = sign.text ? sign.size.x() + kPad * pixelRatio_ : 0;
    const bool left = place.x() + half + textWidth > camera.width() && place.x() > half + textWidth;
    Box box{{place.x() - half - (left ? textWidth : 0), 0},
            {place.x() + half + (left ? 0 : textWidth), 0}};
    const double shift = std::max(0.0, -box.low.x()) - std::max(0.0, box.high.x() - camera.width());
    box.low.x() += shift;
    box.high.x() += shift;
    const double height = kPlate * pixelRatio_;
    const double stem = kStem * pixelRatio_;
    // Below its place where the picture ends above.
    const bool below = place.y() < stem + height;
    box.low.y() = below ? place.y() + stem : place.y() - stem - height;
    box.high.y() = box.low.y() + height;
    for (std::size_t round = 0; round < taken.size(); ++round) {
      const auto covered = std::find_if(taken.begin(), taken.end(),
                                        [&](const Box& other) { return box.overlaps(other); });
      if (covered == taken.end()) break;
      const double gap = 3 * pixelRatio_;
      box.low.y() = below ? covered->high.y() + gap : covered->low.y() - gap - height;
      box.high.y() = box.low.y() + height;
    }
    taken.push_back(box);
    draw(sign, place, box.low, box.high, left, camera, shapes);
  }
}

void WarningSigns::draw(const Sign& sign, const Eigen::Vector2d& place, const Eigen::Vector2d& low,
                        const Eigen::Vector2d& high, bool textOnTheLeft, const Turntable& camera,
                        FlatShapes& shapes) {
  const double half = 0.5 * kPlate * pixelRatio_;
  const Colour plate = mixed(theme_.backgroundTop, theme_.body, 0.05);
  const double end = high.y() < place.y() ? high.y() : low.y();
  shapes.addLine(place, {place.x(), end}, 1.5 * pixelRatio_, theme_.warning);
  shapes.addDisc(place, 3.5 * pixelRatio_, plate);
  shapes.addDisc(place, 2.5 * pixelRatio_, theme_.warning);
  shapes.addRectangle(low, high, plate, 0.93);
  shapes.addFrame(low, high, std::max(1.0, std::round(pixelRatio_)), theme_.warning, 0.8);
  const double middle = 0.5 * (low.y() + high.y());
  const double center = textOnTheLeft ? high.x() - half : low.x() + half;
  addSign({center, middle}, pixelRatio_, theme_.warning, shapes);
  if (!sign.text) return;
  const double textLeft = textOnTheLeft ? low.x() + kPad * pixelRatio_ : low.x() + 2 * half;
  sign.text->SetPosition(std::round(textLeft),
                         std::round(camera.height() - middle - 0.5 * sign.size.y()));
}

}  // namespace palpa::view

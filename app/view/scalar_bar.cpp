#include "app/view/scalar_bar.h"

#include <algorithm>

#include "app/view/colour_map.h"
#include "app/view/flat.h"
#include "app/view/text.h"
#include "app/view/ticks.h"

namespace palpa::view {
namespace {

constexpr int kStrips = 256;
constexpr double kBarWidth = 1.35;  ///< in font sizes, as all lengths here

int wantedTicks(double barHeight, double fontSize) {
  return std::clamp(static_cast<int>(barHeight / (3.2 * fontSize)), 2, 8);
}

std::string superscript(int exponent) {
  std::string text = exponent < 0 ? "-" : "";
  return text + std::to_string(std::abs(exponent));
}

/// "mm", or with a factor of ten "10^-6 MPa".
std::string unitText(const ScalarField& field, const Ticks& ticks) {
  if (ticks.exponent == 0) return field.unit;
  return "10^" + superscript(ticks.exponent) + (field.unit.empty() ? "" : " " + field.unit);
}

}  // namespace

ScalarBar::ScalarBar(const ScalarField& field, double height, double fontSize, double pixel,
                     vtkRenderer* overlay)
    : field_(field), height_(height), fontSize_(fontSize), pixel_(pixel), overlay_(overlay) {
  const Ticks ticks = fieldTicks(field, wantedTicks(height, fontSize));
  const std::string unit = unitText(field, ticks);
  title_ = field.name + (unit.empty() ? "" : "\n" + unit);
  if (!field.values.empty()) {
    const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
    // What is beyond the range has no meaning as an extreme.
    if (!field.isCapped) extremes_ = "max  " + threeDigits(*high) + "\n";
    extremes_ += "min  " + threeDigits(*low);
  }
  width_ = textSize(makeText(title_, {fontSize, true}), overlay).x();
  width_ = std::max(width_, textSize(makeText(extremes_, {0.87 * fontSize}), overlay).x());
  for (const std::string& label : ticks.labels) {
    const double labelWidth = textSize(makeText(label, {fontSize}), overlay).x();
    width_ = std::max(width_, (kBarWidth + 0.7) * fontSize + labelWidth);
  }
}

void ScalarBar::draw(const Eigen::Vector2d& corner) const {
  const auto title = makeText(title_, {fontSize_, true});
  const auto extremes = makeText(extremes_, {0.87 * fontSize_});
  const double titleHeight = textSize(title, overlay_).y();
  const double extremesHeight = textSize(extremes, overlay_).y();
  placeText(title, corner - Eigen::Vector2d(0, titleHeight), overlay_);
  placeText(extremes, corner - Eigen::Vector2d(0, height_), overlay_);

  const Rectangle bar{corner.x(), corner.y() - height_ + extremesHeight + 0.9 * fontSize_,
                      corner.x() + kBarWidth * fontSize_,
                      corner.y() - titleHeight - 0.9 * fontSize_};
  const auto range = colourNumberRange(field_);
  const auto map = colourMap(field_);
  for (int i = 0; i < kStrips; ++i) {
    const double low = bar.bottom + bar.height() * i / kStrips;
    const double high = bar.bottom + bar.height() * (i + 1) / kStrips;
    Colour colour{};
    map->GetColor(range[0] + (range[1] - range[0]) * (i + 0.5) / kStrips, colour.data());
    // A pixel of overlap hides the seams between strips.
    addFlatRectangle({bar.left, low, bar.right, std::min(high + pixel_, bar.top)}, colour,
                     overlay_);
  }
  addFlatLine({{bar.left, bar.bottom},
               {bar.right, bar.bottom},
               {bar.right, bar.top},
               {bar.left, bar.top},
               {bar.left, bar.bottom}},
              kLineColour, pixel_, overlay_);

  const Ticks ticks = fieldTicks(field_, wantedTicks(height_, fontSize_));
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double share = (colourNumber(field_, ticks.values[i]) - range[0]) / (range[1] - range[0]);
    const double y = bar.bottom + share * bar.height();
    addFlatLine({{bar.right, y}, {bar.right + 0.35 * fontSize_, y}}, kLineColour, pixel_, overlay_);
    const auto label = makeText(ticks.labels[i], {fontSize_});
    const double half = 0.5 * textSize(label, overlay_).y();
    placeText(label, {bar.right + 0.7 * fontSize_, y - half}, overlay_);
  }
}

}  // namespace palpa::view

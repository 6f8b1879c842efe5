#include "app/view/colour_bar.h"

#include <algorithm>
#include <cmath>

#include "app/view/colour_map.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kBarWidth = 16;
constexpr double kTick = 4;
constexpr double kPad = 10;
constexpr double kFromEdge = 12;
constexpr double kTallest = 300;

constexpr double kShareOfHeight = 0.62;  // of the picture
constexpr int kStrips = 128;

/// "Displacement" and below it "mm", or with a factor of ten "10^-6 MPa".
std::vector<std::string> titlesOf(const ScalarField& field, const Ticks& ticks) {
  std::string unit = field.unit;
  if (ticks.exponent != 0) {
    unit = "×10^" + std::to_string(ticks.exponent) + (unit.empty() ? "" : " " + unit);
  }
  return {field.name, unit};
}

}  // namespace

ColourBar::ColourBar(vtkRenderer* overlay)
    : titles_(overlay),
      numbers_(overlay),
      colours_(colourSteps(ScalarField::Colours::kSequential, kStrips)) {}

void ColourBar::set(const std::optional<ScalarField>& field, const ViewportTheme& theme,
                    double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  field_ = field;
  titles_.hideAll();
  numbers_.hideAll();
  if (!field_) return;
  range_ = colourRange(*field_);
  if (field_->colours == coloursOf_) return;
  coloursOf_ = field_->colours;
  colours_ = colourSteps(coloursOf_, kStrips);
}

void ColourBar::update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes) {
  if (!field_) return;
  const double unit = pixelRatio_;
  const double height = std::min(kTallest * unit, kShareOfHeight * camera.height());
  const int wanted = std::clamp(static_cast<int>(height / (3 * kFontSize * unit)), 2, 8);
  const Ticks ticks = niceTicks(range_[0], range_[1], wanted);
  const TextStyle style{kFontSize * unit, false, theme_.text};
  titles_.set(titlesOf(*field_, ticks), {style.size, true, theme_.text});
  numbers_.set(ticks.labels, style);

  double width = 0;
  for (std::size_t i = 0; i < ticks.labels.size(); ++i)
    width = std::max(width, (kBarWidth + kTick + 4) * unit + numbers_.extent(i).x());
  double top = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    width = std::max(width, titles_.extent(i).x());
    if (titles_.extent(i).y() > 0) top += titles_.extent(i).y() + 4 * unit;
  }
  const Eigen::Vector2d pad = Eigen::Vector2d::Constant(kPad * unit);
  const Eigen::Vector2d size = (Eigen::Vector2d(width, height) + 2 * pad).array().ceil();
  const double right = camera.width() - kFromEdge * unit;
  const Eigen::Vector2d low(std::round(right - size.x()),
                            std::round(0.5 * (camera.height() - size.y())));
  const PixelBox plate{low, low + size};
  taken.push_back(plate);
  shapes.addPlate(plate.low, plate.high, theme_.text, theme_, unit, 0.3);

  Eigen::Vector2d corner = low + pad;
  for (std::size_t i = 0; i < 2; ++i) {
    if (titles_.extent(i).isZero()) continue;
    titles_.place(i, corner, camera.height());
    corner.y() += titles_.extent(i).y() + 4 * unit;
  }
  const double halfNumber = ticks.labels.empty() ? 0 : 0.5 * numbers_.extent(0).y();
  const Eigen::Vector2d barLow(corner.x(), std::round(corner.y() + halfNumber + 2 * unit));
  const Eigen::Vector2d barHigh(corner.x() + std::round(kBarWidth * unit),
                                std::round(plate.high.y() - pad.y() - halfNumber));
  drawColours(barLow, barHigh, shapes);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double share = (ticks.values[i] - range_[0]) / (range_[1] - range_[0]);
    const double y = barHigh.y() - share * (barHigh.y() - barLow.y());
    const double line = std::max(1.0, std::round(unit));
    const double lineTop = std::round(y - 0.5 * line);
    shapes.addRectangle({barHigh.x(), lineTop}, {barHigh.x() + kTick * unit, lineTop + line},
                        theme_.text, 0.8);
    numbers_.place(i, {barHigh.x() + (kTick + 4) * unit, y - 0.5 * numbers_.extent(i).y()},
                   camera.height());
  }
}

void ColourBar::drawColours(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                            FlatShapes& shapes) {
  const double step = (high.y() - low.y()) / kStrips;
  // From the top; each strip reaches below the next, so that there are no seams.
  for (int i = kStrips - 1; i >= 0; --i) {
    const double top = high.y() - (i + 1) * step;
    shapes.addRectangle({low.x(), top}, {high.x(), std::min(high.y(), top + 2 * step)},
                        colours_[static_cast<std::size_t>(i)]);
  }
  shapes.addFrame(low, high, std::max(1.0, std::round(pixelRatio_)), theme_.text, 0.55);
}

}  // namespace palpa::view

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
constexpr double kToNumber = 4;
constexpr double kPad = 7;
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
  if (!field_) {
    titles_.hideAll();
    numbers_.hideAll();
    return;
  }
  range_ = colourNumberRange(*field_);
  if (field_->colours == coloursOf_) return;
  coloursOf_ = field_->colours;
  colours_ = colourSteps(coloursOf_, kStrips);
}

Ticks ColourBar::ticks(double pictureHeight) const {
  const double height = std::min(kTallest * pixelRatio_, kShareOfHeight * pictureHeight);
  const int wanted = std::clamp(static_cast<int>(height / (3 * kFontSize * pixelRatio_)), 2, 8);
  return fieldTicks(*field_, wanted);
}

double ColourBar::reach(double pictureHeight) {
  if (!field_) return 0;
  const double unit = pixelRatio_;
  const Ticks numbers = ticks(pictureHeight);
  numbers_.set(numbers.labels, {kFontSize * unit, false, theme_.text});
  double width = 0;
  for (std::size_t i = 0; i < numbers.labels.size(); ++i)
    width = std::max(width, numbers_.extent(i).x());
  return width + (kBarWidth + kTick + kToNumber + 2 * kPad + kFromEdge) * unit;
}

void ColourBar::update(const Turntable& camera, std::vector<PixelBox>& taken, FlatShapes& shapes) {
  if (!field_) return;
  const double unit = pixelRatio_;
  const double height = std::min(kTallest * unit, kShareOfHeight * camera.height());
  const Ticks ticks = this->ticks(camera.height());
  const TextStyle style{kFontSize * unit, false, theme_.text};
  titles_.set(titlesOf(*field_, ticks), {style.size, true, theme_.text});
  numbers_.set(ticks.labels, style);

  // Two plates, one below the other: the bar's own is narrow and leaves the view free.
  const Eigen::Vector2d pad = Eigen::Vector2d(kPad, kPad) * unit;
  const double gap = 4 * unit;
  Eigen::Vector2d titles(0, -gap);
  for (std::size_t i = 0; i < 2; ++i) {
    if (titles_.extent(i).isZero()) continue;
    titles.x() = std::max(titles.x(), titles_.extent(i).x());
    titles.y() += titles_.extent(i).y() + gap;
  }
  double numbersWidth = 0;
  for (std::size_t i = 0; i < ticks.labels.size(); ++i)
    numbersWidth = std::max(numbersWidth, numbers_.extent(i).x());
  const Eigen::Vector2d bar((kBarWidth + kTick + kToNumber) * unit + numbersWidth, height);
  const Eigen::Vector2d titleSize =
      titles.y() > 0 ? Eigen::Vector2d(titles + 2 * pad) : Eigen::Vector2d(0, 0);
  const Eigen::Vector2d barSize = bar + 2 * pad;
  const double right = std::round(camera.width() - kFromEdge * unit);
  const double top = std::round(0.5 * (camera.height() - titleSize.y() - barSize.y()));
  const PixelBox titlePlate{{std::round(right - titleSize.x()), top},
                            {right, std::round(top + titleSize.y())}};
  const PixelBox plate{{std::round(right - barSize.x()), titlePlate.high.y()},
                       {right, std::round(titlePlate.high.y() + barSize.y())}};
  for (const PixelBox& box : {titlePlate, plate}) {
    if (box.high.y() == box.low.y()) continue;
    taken.push_back(box);
    shapes.addPlate(box.low, box.high, theme_.text, theme_, unit, 0.2);
  }

  Eigen::Vector2d corner = titlePlate.low + pad;
  for (std::size_t i = 0; i < 2; ++i) {
    if (titles_.extent(i).isZero()) continue;
    titles_.place(i, corner, camera.height());
    corner.y() += titles_.extent(i).y() + gap;
  }
  const double halfNumber = ticks.labels.empty() ? 0 : 0.5 * numbers_.extent(0).y();
  const Eigen::Vector2d barLow = (plate.low + pad + Eigen::Vector2d(0, halfNumber)).array().round();
  const Eigen::Vector2d barHigh(barLow.x() + std::round(kBarWidth * unit),
                                std::round(plate.high.y() - pad.y() - halfNumber));
  drawColours(barLow, barHigh, shapes);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double share =
        (colourNumber(*field_, ticks.values[i]) - range_[0]) / (range_[1] - range_[0]);
    const double y = barHigh.y() - share * (barHigh.y() - barLow.y());
    const double line = std::max(1.0, std::round(unit));
    const double lineTop = std::round(y - 0.5 * line);
    shapes.addRectangle({barHigh.x(), lineTop}, {barHigh.x() + kTick * unit, lineTop + line},
                        theme_.text, 0.8);
    numbers_.place(i, {barHigh.x() + (kTick + kToNumber) * unit, y - 0.5 * numbers_.extent(i).y()},
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

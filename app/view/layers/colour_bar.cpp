#include "app/view/layers/colour_bar.h"

#include <algorithm>
#include <cmath>

#include "app/view/scene/colour_map.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kSmallFontSize = 11.5;
constexpr double kBarWidth = 16;
constexpr double kTick = 4;
constexpr double kToNumber = 4;
constexpr double kPad = 7;
constexpr double kFromEdge = 12;
constexpr double kTallest = 300;
constexpr double kMinHeight = 40;
constexpr double kWords = 52;  // height of a plate with two lines, about

constexpr double kShareOfHeight = 0.62;  // of the picture between the captions
constexpr int kStrips = 128;

/// Widest and total extent of texts below each other.
Eigen::Vector2d extentOf(const TextPool& texts, double gap) {
  Eigen::Vector2d extent(0, -gap);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts.extent(i).isZero()) continue;
    extent.x() = std::max(extent.x(), texts.extent(i).x());
    extent.y() += texts.extent(i).y() + gap;
  }
  return extent.cwiseMax(0.0);
}

void placeBelow(const Eigen::Vector2d& corner, double gap, int pictureHeight, TextPool& texts) {
  Eigen::Vector2d place = corner;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts.extent(i).isZero()) continue;
    texts.place(i, place, pictureHeight);
    place.y() += texts.extent(i).y() + gap;
  }
}

}  // namespace

ColourBar::ColourBar(vtkRenderer* overlay)
    : titles_(overlay),
      numbers_(overlay),
      extremes_(overlay),
      colours_(colourSteps(ScalarField::Colours::kSequential, kStrips)) {}

void ColourBar::set(const std::optional<ScalarField>& field, const ViewportTheme& theme,
                    double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  field_ = field;
  if (!field_) {
    for (TextPool* texts : {&titles_, &numbers_, &extremes_}) texts->hideAll();
    return;
  }
  range_ = colourNumberRange(*field_);
  if (field_->colours == coloursOf_) return;
  coloursOf_ = field_->colours;
  colours_ = colourSteps(coloursOf_, kStrips);
}

double ColourBar::barHeight(double pictureHeight, const Reserve& caption) const {
  const double free = pictureHeight - caption.top - caption.bottom;
  const double words = (field_->extremes ? 2 : 1) * kWords * pixelRatio_;
  return std::min({kTallest * pixelRatio_, kShareOfHeight * free,
                   std::max(free - words, kMinHeight * pixelRatio_)});
}

Ticks ColourBar::setTexts(double height) {
  const double size = kFontSize * pixelRatio_;
  const Ticks ticks = fieldTicks(*field_, std::clamp(static_cast<int>(height / (3 * size)), 2, 8));
  const ScaledUnit unit = scaledUnit(field_->unit, ticks.exponent);
  const double factor = std::pow(10.0, unit.exponent);
  titles_.set({field_->name, unit.name}, {size, true, theme_.text});
  numbers_.set(ticks.labels, {size, false, theme_.text});
  std::vector<std::string> extremes;
  if (field_->extremes) {
    // Beyond the end of a stiffness map the largest value is not known.
    if (!field_->isCapped || field_->colours == ScalarField::Colours::kDiverging)
      extremes.push_back("max  " + threeDigits((*field_->extremes)[1] / factor));
    extremes.push_back("min  " + threeDigits((*field_->extremes)[0] / factor));
  }
  extremes_.set(extremes, {kSmallFontSize * pixelRatio_, false, theme_.text});
  return ticks;
}

double ColourBar::reach(double pictureHeight, const Reserve& caption, bool withWords) {
  if (!field_) return 0;
  setTexts(barHeight(pictureHeight, caption));
  double width = (kBarWidth + kTick + kToNumber) * pixelRatio_ + extentOf(numbers_, 0).x();
  if (withWords) width = std::max({width, extentOf(titles_, 0).x(), extentOf(extremes_, 0).x()});
  return width + (2 * kPad + kFromEdge) * pixelRatio_;
}

void ColourBar::update(const Turntable& camera, const Reserve& caption,
                       std::vector<PixelBox>& taken, FlatShapes& shapes) {
  if (!field_) return;
  const double unit = pixelRatio_;
  const double height = barHeight(camera.height(), caption);
  const Ticks ticks = setTexts(height);

  // Plates below each other: the bar's own is narrow and leaves the view free.
  const Eigen::Vector2d pad = Eigen::Vector2d(kPad, kPad) * unit;
  const double gap = 4 * unit;
  const auto padded = [&](const Eigen::Vector2d& extent) {
    return extent.isZero() ? extent : Eigen::Vector2d(extent + 2 * pad);
  };
  const Eigen::Vector2d titleSize = padded(extentOf(titles_, gap));
  const Eigen::Vector2d barSize =
      padded({(kBarWidth + kTick + kToNumber) * unit + extentOf(numbers_, 0).x(), height});
  const Eigen::Vector2d extremesSize = padded(extentOf(extremes_, gap));
  const double right = std::round(camera.width() - kFromEdge * unit);
  double top = std::round(0.5 * (camera.height() + caption.top - caption.bottom - titleSize.y() -
                                 barSize.y() - extremesSize.y()));
  const auto addPlate = [&](const Eigen::Vector2d& size) {
    const PixelBox box{{std::round(right - size.x()), top}, {right, std::round(top + size.y())}};
    top = box.high.y();
    if (size.isZero()) return box;
    taken.push_back(box);
    shapes.addPlate(box.low, box.high, theme_.text, theme_, unit, 0.2);
    return box;
  };
  placeBelow(addPlate(titleSize).low + pad, gap, camera.height(), titles_);
  const PixelBox plate = addPlate(barSize);
  placeBelow(addPlate(extremesSize).low + pad, gap, camera.height(), extremes_);

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

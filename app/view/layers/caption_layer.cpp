#include "app/view/layers/caption_layer.h"

#include <algorithm>
#include <cmath>

#include "app/view/layers/orientation_axes.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kTitleSize = 17;
constexpr double kFontSize = 13;
constexpr double kMargin = 14;
constexpr double kLineHeight = 1.45;  // font sizes
constexpr double kSwatch = 13;        // side of the hatched square
constexpr double kToWords = 7;        // from there
constexpr int kStrokes = 3;

/// Sets the texts as large as `style`, or smaller, so that each fits into `width`.
void setFitting(const std::vector<std::string>& words, TextStyle style, double width,
                TextPool& texts) {
  texts.set(words, style);
  double widest = 0;
  for (std::size_t i = 0; i < words.size(); ++i) widest = std::max(widest, texts.extent(i).x());
  if (widest <= width) return;
  style.size = std::floor(style.size * width / widest);
  texts.set(words, style);
}

void addSwatch(const PixelBox& box, const Colour& support, const Colour& stroke, double unit,
               FlatShapes& shapes) {
  shapes.addRectangle(box.low, box.high, support);
  const double side = box.high.x() - box.low.x();
  for (int i = 1; i <= kStrokes; ++i) {
    // Diagonals from the left or lower side to the upper or right one.
    const double along = 2.0 * i / (kStrokes + 1) * side;
    const double begin = std::min(along, side), rest = along - begin;
    shapes.addLine({box.low.x() + rest, box.low.y() + begin},
                   {box.low.x() + begin, box.low.y() + rest}, 1.2 * unit, stroke);
  }
  shapes.addFrame(box.low, box.high, std::max(1.0, std::round(unit)), stroke);
}

/// As the compared body: translucent with a dense rim.
void addGlass(const PixelBox& box, double unit, FlatShapes& shapes) {
  shapes.addRectangle(box.low, box.high, kComparedColour, 0.45);
  shapes.addFrame(box.low, box.high, std::max(1.0, std::round(1.5 * unit)), kComparedColour);
}

}  // namespace

void CaptionLayer::set(const Caption& caption, const ViewportTheme& theme, const Colour& support,
                       const Colour& stroke, double pixelRatio) {
  caption_ = caption;
  theme_ = theme;
  support_ = support;
  stroke_ = stroke;
  pixelRatio_ = pixelRatio;
  title_.hideAll();
  lines_.hideAll();
}

double CaptionLayer::lineHeight() const {
  return std::round(kLineHeight * kFontSize * pixelRatio_);
}

void CaptionLayer::setTexts(double pictureWidth) {
  const double unit = pixelRatio_;
  std::vector<std::string> words;
  if (!caption_.title.empty()) words.push_back(caption_.title);
  setFitting(words, {kTitleSize * unit, true, theme_.text}, pictureWidth - 2 * kMargin * unit,
             title_);
  words.clear();
  if (!caption_.supports.empty()) words.push_back(caption_.supports);
  if (!caption_.compared.empty()) words.push_back(caption_.compared);
  words.insert(words.end(), caption_.lines.begin(), caption_.lines.end());
  const bool hasSwatch = !caption_.supports.empty() || !caption_.compared.empty();
  const double left = OrientationAxes::kSide + (hasSwatch ? kSwatch + kToWords : 0);
  setFitting(words, {kFontSize * unit, false, theme_.text}, pictureWidth - (left + kMargin) * unit,
             lines_);
}

Reserve CaptionLayer::reserve(double pictureWidth) {
  setTexts(pictureWidth);
  Reserve reserve;
  const double margin = kMargin * pixelRatio_;
  if (title_.size() > 0) reserve.top = title_.extent(0).y() + margin;
  if (lines_.size() > 0)
    reserve.bottom = static_cast<double>(lines_.size()) * lineHeight() + margin;
  return reserve;
}

void CaptionLayer::update(const Turntable& camera, std::vector<PixelBox>& taken,
                          FlatShapes& shapes) {
  const double unit = pixelRatio_;
  setTexts(camera.width());
  const auto place = [&](TextPool& texts, std::size_t i, const Eigen::Vector2d& corner) {
    taken.push_back({corner, corner + texts.extent(i)});
    texts.place(i, corner, camera.height());
  };
  if (title_.size() > 0) place(title_, 0, Eigen::Vector2d(kMargin, kMargin) * unit);
  double top = camera.height() - kMargin * unit - static_cast<double>(lines_.size()) * lineHeight();
  for (std::size_t i = 0; i < lines_.size(); ++i, top += lineHeight()) {
    Eigen::Vector2d corner(OrientationAxes::kSide * unit, top);
    const std::size_t ofCompared = caption_.supports.empty() ? 0 : 1;
    const bool isSupports = i == 0 && !caption_.supports.empty();
    const bool isCompared = i == ofCompared && !caption_.compared.empty();
    if (isSupports || isCompared) {
      const Eigen::Vector2d side = Eigen::Vector2d::Constant(std::round(kSwatch * unit));
      const Eigen::Vector2d low =
          (corner + Eigen::Vector2d(0, 0.5 * (lines_.extent(i).y() - side.y()))).array().round();
      if (isSupports)
        addSwatch({low, low + side}, support_, stroke_, unit, shapes);
      else
        addGlass({low, low + side}, unit, shapes);
      corner.x() += (kSwatch + kToWords) * unit;
    }
    place(lines_, i, corner);
  }
}

}  // namespace palpa::view

#include "app/view/layers/orientation_axes.h"

#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

#include "app/view/layers/text.h"
#include "app/view/scene/theme.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kFromCorner = 0.5 * OrientationAxes::kSide;
constexpr double kLength = 30;
constexpr std::array<const char*, 3> kNames{"x", "y", "z"};

}  // namespace

OrientationAxes::OrientationAxes(vtkRenderer* overlay) : overlay_(overlay) {
  for (std::size_t i = 0; i < 3; ++i) {
    letters_[i] = makeText(kNames[i], {kFontSize, true, kAxisColours[i]});
    overlay->AddActor2D(letters_[i]);
  }
}

void OrientationAxes::setVisible(bool visible) {
  visible_ = visible;
  for (vtkTextActor* letter : letters_) letter->SetVisibility(visible);
}

void OrientationAxes::setPixelRatio(double ratio) {
  pixelRatio_ = ratio;
  for (std::size_t i = 0; i < 3; ++i) {
    letters_[i]->GetTextProperty()->SetFontSize(static_cast<int>(std::lround(kFontSize * ratio)));
    sizes_[i] = textSize(letters_[i], overlay_);
  }
}

void OrientationAxes::update(const Turntable& camera, FlatShapes& shapes) {
  if (!visible_) return;
  const ViewAxes axes = camera.axes();
  const Eigen::Vector2d middle(kFromCorner * pixelRatio_,
                               camera.height() - kFromCorner * pixelRatio_);
  // Far axes first, so that near ones cross over them.
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return axes.forward[static_cast<Eigen::Index>(a)] > axes.forward[static_cast<Eigen::Index>(b)];
  });
  for (const std::size_t i : order) {
    const auto k = static_cast<Eigen::Index>(i);
    const Eigen::Vector2d seen(axes.right[k], -axes.up[k]);
    const double length = seen.norm();
    const Colour& colour = kAxisColours[i];
    // Seen end on: a dot with the letter above and to the left.
    Eigen::Vector2d letter = middle + Eigen::Vector2d(-9, -9) * pixelRatio_;
    if (length < 0.12) {
      shapes.addDisc(middle, 3.2 * pixelRatio_, colour);
    } else {
      const Eigen::Vector2d along = seen / length;
      const Eigen::Vector2d across(-along.y(), along.x());
      const Eigen::Vector2d tip = middle + kLength * pixelRatio_ * seen;
      const double head = std::min(9.0, 0.8 * kLength * length) * pixelRatio_;
      const Eigen::Vector2d neck = tip - head * along;
      const double wide = 3.8 * pixelRatio_;
      shapes.addLine(middle, neck, 2 * pixelRatio_, colour);
      shapes.addPolygon({tip, neck + wide * across, neck - wide * across}, colour);
      letter = tip + 10 * pixelRatio_ * along;
    }
    letters_[i]->SetPosition(std::round(letter.x() - 0.5 * sizes_[i].x()),
                             std::round(camera.height() - letter.y() - 0.5 * sizes_[i].y()));
  }
}

}  // namespace palpa::view

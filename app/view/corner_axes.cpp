#include "app/view/corner_axes.h"

#include <algorithm>
#include <array>

#include "app/view/flat.h"
#include "app/view/text.h"

namespace palpa::view {
namespace {

struct Axis {
  Eigen::Vector3d direction;
  const char* name;
  Colour colour;
};

const std::array<Axis, 3> kAxes{{{Eigen::Vector3d::UnitX(), "x", {0.80, 0.16, 0.16}},
                                 {Eigen::Vector3d::UnitY(), "y", {0.13, 0.52, 0.20}},
                                 {Eigen::Vector3d::UnitZ(), "z", {0.13, 0.32, 0.75}}}};

}  // namespace

void addCornerAxes(const CameraView& view, const Rectangle& place, double fontSize, double pixel,
                   vtkRenderer* overlay) {
  const ViewAxes axes = viewAxes(view);
  // Far axes first, so that near ones cross over them.
  std::array<Axis, 3> sorted = kAxes;
  std::sort(sorted.begin(), sorted.end(), [&](const Axis& a, const Axis& b) {
    return a.direction.dot(axes.forward) > b.direction.dot(axes.forward);
  });
  const Eigen::Vector2d middle(0.5 * (place.left + place.right), 0.5 * (place.bottom + place.top));
  const double length = 0.5 * place.width() - fontSize;
  for (const Axis& axis : sorted) {
    const Eigen::Vector2d seen(axis.direction.dot(axes.right), axis.direction.dot(axes.up));
    const auto text = makeText(axis.name, {fontSize, true, axis.colour});
    const Eigen::Vector2d half = 0.5 * textSize(text, overlay);
    if (seen.norm() < 0.12) {
      // Seen end on: a dot with the name beside it.
      const double r = 2.5 * pixel;
      addFlatRectangle({middle.x() - r, middle.y() - r, middle.x() + r, middle.y() + r},
                       axis.colour, overlay);
      placeText(text, middle - half - Eigen::Vector2d(0.6, 0.6) * fontSize, overlay);
      continue;
    }
    const Eigen::Vector2d along = seen.normalized();
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d tip = middle + length * seen;
    const Eigen::Vector2d neck = tip - std::min(8 * pixel, 0.8 * length * seen.norm()) * along;
    addFlatLine({middle, neck}, axis.colour, 2 * pixel, overlay);
    addFlatPolygon({tip, neck + 3.2 * pixel * across, neck - 3.2 * pixel * across}, axis.colour,
                   overlay);
    placeText(text, tip + 0.62 * fontSize * along - half, overlay);
  }
}

}  // namespace palpa::view

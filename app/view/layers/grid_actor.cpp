#include "app/view/layers/grid_actor.h"

#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "app/view/scene/theme.h"
#include "base/round_number.h"

namespace palpa::view {
namespace {

constexpr double kMinCell = 26;  // pixels
constexpr int kStrongEvery = 10;
constexpr double kRadius = 1.0;  // in heights of the picture
constexpr int kPiecesPerLine = 16;

}  // namespace

double gridSpacing(const Turntable& camera, double pixelRatio) {
  return roundedUp(kMinCell * pixelRatio / camera.pixelsPerLength(camera.distance()));
}

double groundLevel(const Bounds& body) {
  if (body.empty() || body.low.z() >= 0) return 0;
  const double step = roundedUp(std::max(0.02 * body.size().norm(), 1e-9));
  // A body that stands on a step up to rounding stays there.
  return step * std::floor(body.low.z() / step + 1e-3);
}

GridActor::GridActor(vtkRenderer* renderer)
    : grid_(makeLines(renderer)), axes_(makeLines(renderer)) {}

GridActor::Lines GridActor::makeLines(vtkRenderer* renderer) {
  Lines lines;
  lines.points = makeFloatPoints();
  lines.colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
  lines.colours->SetNumberOfComponents(4);
  vtkNew<vtkCellArray> none;
  lines.actor = makeLineActor(lines.points, none);
  lines.data = vtkPolyData::SafeDownCast(lines.actor->GetMapper()->GetInput());
  lines.data->GetPointData()->SetScalars(lines.colours);
  lines.actor->GetMapper()->ScalarVisibilityOn();
  lines.actor->GetMapper()->SetScalarModeToUsePointData();
  lines.actor->GetMapper()->SetColorModeToDirectScalars();
  // Behind everything that touches the ground.
  lines.actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(2, 2);
  renderer->AddActor(lines.actor);
  return lines;
}

void GridActor::setVisible(bool visible) {
  grid_.actor->SetVisibility(visible);
  axes_.actor->SetVisibility(visible);
}

void GridActor::setTheme(const ViewportTheme& theme) {
  theme_ = theme;
}

void GridActor::setPixelRatio(double ratio) {
  pixelRatio_ = ratio;
  grid_.actor->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  axes_.actor->GetProperty()->SetLineWidth(static_cast<float>(1.6 * ratio));
}

void GridActor::clear(Lines& lines) {
  lines.points->Reset();
  lines.colours->Reset();
  lines.data->SetLines(vtkSmartPointer<vtkCellArray>::New());
}

void GridActor::finish(Lines& lines) {
  lines.points->Modified();
  lines.colours->Modified();
  lines.data->Modified();
}

void GridActor::addLine(const Area& area, int axis, double at, const Colour& colour, double opacity,
                        Lines& lines) {
  const int other = 1 - axis;
  const double aside = at - area.center[other];
  if (std::abs(aside) >= area.radius) return;
  const double half = std::sqrt(area.radius * area.radius - aside * aside);
  lines.data->GetLines()->InsertNextCell(kPiecesPerLine + 1);
  for (int i = 0; i <= kPiecesPerLine; ++i) {
    const double along = half * (2.0 * i / kPiecesPerLine - 1);
    Eigen::Vector3d point(0, 0, area.level);
    point[axis] = area.center[axis] + along;
    point[other] = at;
    const double rho = (along * along + aside * aside) / (area.radius * area.radius);
    const double fade = std::clamp(1 - rho, 0.0, 1.0);
    lines.data->GetLines()->InsertCellPoint(lines.points->InsertNextPoint(point.data()));
    for (const double value : colour) {
      lines.colours->InsertNextValue(static_cast<unsigned char>(std::lround(255 * value)));
    }
    lines.colours->InsertNextValue(static_cast<unsigned char>(std::lround(255 * opacity * fade)));
  }
}

void GridActor::update(const Turntable& camera, double level) {
  clear(grid_);
  clear(axes_);
  const double spacing = gridSpacing(camera, pixelRatio_);
  const Area area{camera.focus().head<2>(), kRadius * camera.visibleHeight(), level};
  for (const int axis : {0, 1}) {
    const double middle = area.center[1 - axis];
    const auto first = std::llround(std::ceil((middle - area.radius) / spacing));
    const auto last = std::llround(std::floor((middle + area.radius) / spacing));
    for (auto i = first; i <= last; ++i) {
      if (i == 0) continue;
      const double opacity = i % kStrongEvery == 0 ? 0.7 : 0.34;
      addLine(area, axis, spacing * static_cast<double>(i), theme_.grid, opacity, grid_);
    }
    addLine(area, axis, 0, kAxisColours[static_cast<std::size_t>(axis)], 0.9, axes_);
  }
  finish(grid_);
  finish(axes_);
}

}  // namespace palpa::view

#include "app/view/layers/tool_layer.h"

#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <limits>

namespace palpa::view {
namespace {

using Style = ToolDrawing::Style;

// In logical pixels.
constexpr double kFontSize = 13;
constexpr double kDotRadius = 4.5;
constexpr double kTouchRadius = 5;
constexpr double kTouchArrow = 58;
constexpr double kTouchHead = 13;
constexpr double kHiddenOpacity = 0.30;

struct Look {
  Colour colour;
  double width;  ///< logical pixels
  double opacity;
};

Look lookOf(Style style, const ViewportTheme& theme) {
  switch (style) {
    case Style::kGuide:
      return {theme.text, 1.2, 0.55};
    case Style::kHovered:
      return {theme.handleHovered, 3.2, 1};
    case Style::kSelected:
      return {theme.handleSelected, 3.2, 1};
    case Style::kPreview:
      break;
  }
  return {theme.preview, 2.4, 1};
}

/// The part of a line in front of the eye as pixels; false when there is none.
bool seenSegment(const Turntable& camera, Eigen::Vector3d a, Eigen::Vector3d b, Eigen::Vector2d& p,
                 Eigen::Vector2d& q) {
  if (!camera.parallel()) {
    const double nearest = 1e-3 * camera.distance();
    const double depthA = camera.depth(a);
    const double depthB = camera.depth(b);
    if (depthA < nearest && depthB < nearest) return false;
    const Eigen::Vector3d cut = a + (nearest - depthA) / (depthB - depthA) * (b - a);
    if (depthA < nearest) a = cut;
    if (depthB < nearest) b = cut;
  }
  p = camera.toPixel(a);
  q = camera.toPixel(b);
  return p.allFinite() && q.allFinite();
}

}  // namespace

void PlateLabels::set(const std::vector<std::string>& texts, const ViewportTheme& theme,
                      double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  texts_.set(texts, {kFontSize * pixelRatio, false, theme.text});
}

void PlateLabels::place(std::size_t index, const Eigen::Vector2d& pixel, const Colour& frame,
                        const Turntable& camera, FlatShapes& shapes) {
  const Eigen::Vector2d words = texts_.extent(index);
  if (words.isZero() || !pixel.allFinite()) {
    texts_.hide(index);
    return;
  }
  const Eigen::Vector2d pad = kPlatePad * pixelRatio_;
  const Eigen::Vector2d size = words + 2 * pad;
  // To the right and above; to the left or below where the picture ends.
  const double gap = 12 * pixelRatio_;
  Eigen::Vector2d low(pixel.x() + gap, pixel.y() - gap - size.y());
  if (low.x() + size.x() > camera.width() && pixel.x() > gap + size.x()) {
    low.x() = pixel.x() - gap - size.x();
  }
  if (low.y() < 0) low.y() = pixel.y() + gap;
  low = low.array().round();
  shapes.addPlate(low, low + Eigen::Vector2d(size.array().round()), frame, theme_, pixelRatio_);
  texts_.place(index, low + pad, camera.height());
}

ToolLayer::ToolLayer(vtkRenderer* scene, vtkRenderer* overlay) : labels_(overlay) {
  for (Lines& lines : lines_) {
    lines.points = makeFloatPoints();
    lines.actor = makeLineActor(lines.points, vtkSmartPointer<vtkCellArray>::New());
    lines.actor->VisibilityOff();
    scene->AddActor(lines.actor);
  }
}

void ToolLayer::set(const ToolDrawing& drawing, const ViewportTheme& theme, double pixelRatio) {
  drawing_ = drawing;
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  ends_.clear();
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto style = static_cast<Style>(k);
    std::vector<Eigen::Vector3d> points;
    std::vector<std::vector<int>> cells;
    for (const ToolDrawing::Line& line : drawing.lines) {
      if (line.style != style || !line.isHiddenByBody || line.points.size() < 2) continue;
      std::vector<int>& cell = cells.emplace_back();
      for (const Eigen::Vector3d& point : line.points) {
        cell.push_back(static_cast<int>(points.size()));
        points.push_back(point);
      }
    }
    const Lines& lines = lines_[k];
    ends_.insert(ends_.end(), points.begin(), points.end());
    assign(points, lines.points);
    showLines(lines.actor, cells);
    const Look look = lookOf(style, theme);
    setColour(lines.actor, look.colour);
    lines.actor->GetProperty()->SetLineWidth(static_cast<float>(look.width * pixelRatio));
    lines.actor->GetProperty()->SetOpacity(look.opacity);
  }
  std::vector<std::string> texts;
  for (const ToolDrawing::Label& label : drawing.labels) texts.push_back(label.text);
  labels_.set(texts, theme, pixelRatio);
}

void ToolLayer::update(const Turntable& camera, FlatShapes& shapes) {
  for (const ToolDrawing::Line& line : drawing_.lines) {
    if (line.isHiddenByBody) continue;
    const Look look = lookOf(line.style, theme_);
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      Eigen::Vector2d p, q;
      if (!seenSegment(camera, line.points[i - 1], line.points[i], p, q)) continue;
      shapes.addLine(p, q, look.width * pixelRatio_, look.colour, look.opacity);
    }
  }
  for (const ToolDrawing::Dot& dot : drawing_.dots) {
    const Eigen::Vector2d pixel = camera.toPixel(dot.at);
    if (!pixel.allFinite()) continue;
    shapes.addDisc(pixel, (kDotRadius + 1.2) * pixelRatio_, theme_.line);
    shapes.addDisc(pixel, kDotRadius * pixelRatio_, lookOf(dot.style, theme_).colour);
  }
  for (std::size_t i = 0; i < drawing_.labels.size(); ++i) {
    labels_.place(i, camera.toPixel(drawing_.labels[i].at), theme_.text, camera, shapes);
  }
}

void TouchLayer::set(const std::vector<TouchMarker>& markers, const ViewportTheme& theme,
                     double pixelRatio) {
  markers_ = markers;
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  std::vector<std::string> texts;
  for (const TouchMarker& marker : markers) texts.push_back(marker.label);
  labels_.set(texts, theme, pixelRatio);
}

void TouchLayer::update(const Turntable& camera,
                        const std::function<bool(const Eigen::Vector3d&)>& hidden,
                        FlatShapes& shapes) {
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    const TouchMarker& marker = markers_[i];
    Eigen::Vector2d pixel = camera.toPixel(marker.at);
    if (!visible_) pixel.setConstant(std::numeric_limits<double>::quiet_NaN());
    const Colour colour = marker.isSelected ? theme_.selected : theme_.touch;
    labels_.place(i, pixel, colour, camera, shapes);
    if (!pixel.allFinite()) continue;
    const double opacity = hidden(marker.at) ? kHiddenOpacity : 1;
    const double unit = pixelRatio_ * (marker.isSelected ? 1.25 : 1);
    if (marker.direction.norm() > 0) {
      // In the scene it is as long everywhere: foreshortened where it points at the viewer.
      const double length = kTouchArrow * unit / camera.pixelsPerLength(camera.depth(marker.at));
      const Eigen::Vector2d tip =
          camera.toPixel(marker.at + length * marker.direction.normalized());
      const Eigen::Vector2d along = tip - pixel;
      if (tip.allFinite() && along.norm() > 1) {
        const Eigen::Vector2d ahead = along.normalized();
        const Eigen::Vector2d across(-ahead.y(), ahead.x());
        const double head = std::min(kTouchHead * unit, along.norm());
        const Eigen::Vector2d neck = tip - head * ahead;
        shapes.addLine(pixel, neck, 2.6 * unit, colour, opacity);
        shapes.addPolygon({tip, neck + 0.42 * head * across, neck - 0.42 * head * across}, colour,
                          opacity);
      }
    }
    shapes.addDisc(pixel, (kTouchRadius + 1.4) * unit, theme_.line, opacity);
    shapes.addDisc(pixel, kTouchRadius * unit, colour, opacity);
    shapes.addDisc(pixel, 0.4 * kTouchRadius * unit, {1, 1, 1}, opacity);
  }
}

}  // namespace palpa::view

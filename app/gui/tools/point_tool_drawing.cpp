#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "app/gui/document/gradient_words.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/tools/motion_geometry.h"
#include "app/gui/tools/point_tool.h"
#include "modeling/solid/surface_properties.h"

// Drawing of PointTool, and its measures of the view.
namespace palpa::gui {
namespace {

using view::GizmoAxis;
using view::ToolDrawing;

constexpr int kRingPieces = 64;

double sizeOf(const modeling::Solid& solid) {
  const auto [low, high] = modeling::boundingBox(solid);
  return (high - low).norm();
}

}  // namespace

std::array<Eigen::Vector3d, 2> PointTool::screenAxes() const {
  const view::Viewport& viewport = workspace_.view.viewport();
  const Eigen::Vector3d through =
      workspace_.scene.selectionCentre().value_or(Eigen::Vector3d(Eigen::Vector3d::Zero()));
  const Eigen::Vector2d pixel = viewport.toPixel(through);
  const Eigen::Vector3d origin = viewport.inViewPlane(pixel, through);
  const auto along = [&](const Eigen::Vector2d& step) {
    return Eigen::Vector3d((viewport.inViewPlane(pixel + step, through) - origin).normalized());
  };
  return {along({100, 0}), along({0, -100})};
}

Eigen::Vector3d PointTool::directionOf(const Motion& motion) const {
  switch (motion.axis) {
    case GizmoAxis::kX:
      return Eigen::Vector3d::UnitX();
    case GizmoAxis::kY:
      return Eigen::Vector3d::UnitY();
    case GizmoAxis::kZ:
      return Eigen::Vector3d::UnitZ();
    case GizmoAxis::kNormal:
      return motion.normal;
    case GizmoAxis::kGradient:
      return motion.gradient;
    default:
      break;
  }
  const auto [right, up] = screenAxes();
  return right.cross(up);
}

QString PointTool::axisName(const Motion& motion) const {
  switch (motion.axis) {
    case GizmoAxis::kX:
      return "x";
    case GizmoAxis::kY:
      return "y";
    case GizmoAxis::kZ:
      return "z";
    case GizmoAxis::kNormal:
      return tr("normal");
    case GizmoAxis::kGradient:
      return tr("gradient");
    default:
      return {};
  }
}

double PointTool::lengthStep() const {
  return roundLengthBelow(sizeOf(*workspace_.editor.solid()) / 100);
}

ShownUnits PointTool::units() const {
  return workspace_.settings.units();
}

void PointTool::refresh() {
  const modeling::Solid* solid = workspace_.editor.solid();
  if (!motion_)
    workspace_.scene.setFollowing(solid ? followersOf(movedPoints(), options_.reach(*solid), *solid)
                                        : std::set<int>());
  draw();
}

void PointTool::draw() {
  if (!isActive_) return;
  ToolDrawing drawing;
  const std::set<int>& edges = workspace_.editor.selection().edges;
  for (int edge : edges)
    drawing.lines.push_back(
        {workspace_.scene.edgeLine(edge), ToolDrawing::Style::kSelected, false});
  if (const auto edge = picker_.hoveredEdge(); edge && !edges.contains(*edge))
    drawing.lines.push_back(
        {workspace_.scene.edgeLine(*edge), ToolDrawing::Style::kHovered, false});
  std::erase_if(drawing.lines, [](const ToolDrawing::Line& line) { return line.points.empty(); });
  if (motion_) drawMotion(drawing);
  workspace_.view.viewport().setToolDrawing(drawing);
  workspace_.view.update();
}

void PointTool::drawMotion(ToolDrawing& drawing) const {
  const modeling::Solid& solid = *workspace_.editor.solid();
  const double size = sizeOf(solid);
  if (motion_->axis != GizmoAxis::kAll) {
    const Eigen::Vector3d arm = 2.0 * size * directionOf(*motion_);
    drawing.lines.push_back(
        {{motion_->centre - arm, motion_->centre + arm}, ToolDrawing::Style::kGuide, false});
  }
  const Eigen::Vector3d centre = meanOf(movedPoints(), solid);
  if (motion_->reach.falloff) {
    const auto [right, up] = screenAxes();
    ToolDrawing::Line ring{{}, ToolDrawing::Style::kGuide, false};
    const Eigen::Vector3d middle = motion_->place + centre - motion_->centre;
    for (int i = 0; i <= kRingPieces; ++i) {
      const double angle = 2 * std::numbers::pi * i / kRingPieces;
      ring.points.push_back(middle + *motion_->reach.falloff *
                                         (std::cos(angle) * right + std::sin(angle) * up));
    }
    drawing.lines.push_back(std::move(ring));
  }
  if (motion_->target && motion_->typed.isEmpty() && kind() == view::GizmoKind::kMove)
    drawing.dots.push_back({motion_->target->at, ToolDrawing::Style::kHovered});
  QString text = describe(*motion_);
  if (!motion_->typed.isEmpty())
    text = (axisName(*motion_) + " " + motion_->typed + "_  =  " + text).trimmed();
  if (const auto stiffness = workspace_.editor.gradient().stiffness();
      stiffness && motion_->stiffness)
    text += "\n" + changedStiffnessText(workspace_.editor.gradient().name(), *stiffness,
                                        *motion_->stiffness, units());
  drawing.labels.push_back({centre, text.toStdString()});
}

}  // namespace palpa::gui

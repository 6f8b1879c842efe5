#include "app/view/gizmo_actor.h"

#include <vtkAppendPolyData.h>
#include <vtkConeSource.h>
#include <vtkCylinderSource.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/view/axis_colours.h"
#include "app/view/segment.h"

namespace palpa::view {
namespace {

// In logical pixels.
constexpr double kStart = 14;
constexpr double kEnd = 90;
constexpr double kHeadLength = 19;
constexpr double kHeadRadius = 6;
constexpr double kShaftRadius = 1.6;
constexpr double kMiddleRadius = 4;
constexpr double kReach = 8;
constexpr double kShortestSeen = 26;

/// An arrow along x from kStart to kEnd.
vtkSmartPointer<vtkActor> makeArrow(vtkRenderer* renderer) {
  vtkNew<vtkCylinderSource> shaft;  // along y
  shaft->SetHeight(kEnd - kHeadLength - kStart);
  shaft->SetCenter(0, 0.5 * (kStart + kEnd - kHeadLength), 0);
  shaft->SetRadius(kShaftRadius);
  shaft->SetResolution(16);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(-90);
  vtkNew<vtkTransformPolyDataFilter> turned;
  turned->SetTransform(turn);
  turned->SetInputConnection(shaft->GetOutputPort());
  vtkNew<vtkConeSource> head;
  head->SetCenter(kEnd - 0.5 * kHeadLength, 0, 0);
  head->SetHeight(kHeadLength);
  head->SetRadius(kHeadRadius);
  head->SetResolution(32);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(turned->GetOutputPort());
  both->AddInputConnection(head->GetOutputPort());

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(both->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.62);
  actor->GetProperty()->SetDiffuse(0.45);
  renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> makeMiddle(vtkRenderer* renderer) {
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(kMiddleRadius);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.7);
  actor->GetProperty()->SetDiffuse(0.35);
  renderer->AddActor(actor);
  return actor;
}

const Colour& colourOf(GizmoAxis axis) {
  return axis == GizmoAxis::kNormal ? kNormalColour
                                    : kAxisColours[static_cast<std::size_t>(axis) - 1];
}

/// Takes the x axis to `direction`, scales, and moves to `at`.
vtkSmartPointer<vtkMatrix4x4> placed(const Eigen::Vector3d& at, const Eigen::Vector3d& direction,
                                     double scale) {
  const Eigen::Vector3d across = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << direction, across, direction.cross(across);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix->SetElement(row, column, scale * axes(row, column));
    }
    matrix->SetElement(row, 3, at[row]);
  }
  return matrix;
}

}  // namespace

std::vector<GizmoArrow> gizmoArrows(const Gizmo& gizmo, const Turntable& camera,
                                    double pixelRatio) {
  const double depth = camera.depth(gizmo.at);
  std::vector<GizmoArrow> arrows;
  if (!camera.toPixel(gizmo.at).allFinite()) return arrows;
  const double scale = pixelRatio / camera.pixelsPerLength(depth);  // mm per logical pixel
  const auto add = [&](GizmoAxis axis, const Eigen::Vector3d& direction) {
    const GizmoArrow arrow{axis, direction, gizmo.at + scale * kStart * direction,
                           gizmo.at + scale * kEnd * direction};
    const double seen = (camera.toPixel(arrow.end) - camera.toPixel(gizmo.at)).norm();
    // Also false for an arrow that ends behind the eye.
    if (seen >= kShortestSeen * pixelRatio) arrows.push_back(arrow);
  };
  add(GizmoAxis::kX, Eigen::Vector3d::UnitX());
  add(GizmoAxis::kY, Eigen::Vector3d::UnitY());
  add(GizmoAxis::kZ, Eigen::Vector3d::UnitZ());
  if (gizmo.normal && gizmo.normal->norm() > 0) add(GizmoAxis::kNormal, gizmo.normal->normalized());
  return arrows;
}

GizmoAxis gizmoAxisAt(const Eigen::Vector2d& pixel, const Gizmo& gizmo, const Turntable& camera,
                      double pixelRatio) {
  GizmoAxis nearest = GizmoAxis::kNone;
  double smallest = kReach * pixelRatio;
  for (const GizmoArrow& arrow : gizmoArrows(gizmo, camera, pixelRatio)) {
    const double distance =
        distanceToSegment(pixel, camera.toPixel(arrow.start), camera.toPixel(arrow.end));
    if (distance <= smallest) {
      smallest = distance;
      nearest = arrow.axis;
    }
  }
  return nearest;
}

GizmoActor::GizmoActor(vtkRenderer* renderer) : middle_(makeMiddle(renderer)) {
  for (vtkSmartPointer<vtkActor>& arrow : arrows_) arrow = makeArrow(renderer);
}

void GizmoActor::update(const std::optional<Gizmo>& gizmo, const Turntable& camera,
                        double pixelRatio) {
  for (vtkActor* arrow : arrows_) arrow->VisibilityOff();
  middle_->VisibilityOff();
  if (!gizmo) return;
  const double depth = camera.depth(gizmo->at);
  for (const GizmoArrow& arrow : gizmoArrows(*gizmo, camera, pixelRatio)) {
    const double scale = pixelRatio / camera.pixelsPerLength(depth);
    const bool highlighted = arrow.axis == gizmo->highlighted;
    vtkActor* actor = arrows_[static_cast<std::size_t>(arrow.axis) - 1];
    actor->SetUserMatrix(placed(gizmo->at, arrow.direction, scale));
    setColour(actor, highlighted ? kHighlightColour : colourOf(arrow.axis));
    actor->VisibilityOn();
    middle_->SetUserMatrix(placed(gizmo->at, Eigen::Vector3d::UnitX(), scale));
    middle_->VisibilityOn();
  }
}

}  // namespace palpa::view

#include "app/view/layers/gizmo_actor.h"

#include <vtkAlgorithm.h>
#include <vtkAppendPolyData.h>
#include <vtkConeSource.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <Eigen/Geometry>

#include "app/view/scene/theme.h"

namespace palpa::view {
namespace {

using gizmo_size::kEnd;
using gizmo_size::kStart;

// In logical pixels.
constexpr double kHeadLength = 19;
constexpr double kHeadRadius = 6;
constexpr double kBox = 12;
constexpr double kShaftRadius = 1.6;
constexpr double kRingWidth = 2.6;

const Colour kMiddleColour{0.97, 0.97, 0.98};
const Colour kOuterRingColour{0.62, 0.65, 0.70};

vtkSmartPointer<vtkActor> makeActor(vtkAlgorithm* shape, vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(shape->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.62);
  actor->GetProperty()->SetDiffuse(0.45);
  renderer->AddActor(actor);
  return actor;
}

/// A shaft along x from kStart to the head, which ends at kEnd.
vtkSmartPointer<vtkActor> makeHandle(vtkAlgorithm* head, double headLength, vtkRenderer* renderer) {
  vtkNew<vtkCylinderSource> shaft;  // along y
  shaft->SetHeight(kEnd - headLength - kStart);
  shaft->SetCenter(0, 0.5 * (kStart + kEnd - headLength), 0);
  shaft->SetRadius(kShaftRadius);
  shaft->SetResolution(16);
  vtkNew<vtkTransform> turn;
  turn->RotateZ(-90);
  vtkNew<vtkTransformPolyDataFilter> turned;
  turned->SetTransform(turn);
  turned->SetInputConnection(shaft->GetOutputPort());
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(turned->GetOutputPort());
  both->AddInputConnection(head->GetOutputPort());
  return makeActor(both, renderer);
}

vtkSmartPointer<vtkActor> makeArrow(vtkRenderer* renderer) {
  vtkNew<vtkConeSource> head;
  head->SetCenter(kEnd - 0.5 * kHeadLength, 0, 0);
  head->SetHeight(kHeadLength);
  head->SetRadius(kHeadRadius);
  head->SetResolution(32);
  return makeHandle(head, kHeadLength, renderer);
}

vtkSmartPointer<vtkActor> makeBox(vtkRenderer* renderer) {
  vtkNew<vtkCubeSource> box;
  box->SetCenter(kEnd - 0.5 * kBox, 0, 0);
  box->SetXLength(kBox);
  box->SetYLength(kBox);
  box->SetZLength(kBox);
  return makeHandle(box, kBox, renderer);
}

vtkSmartPointer<vtkActor> makeMiddle(vtkRenderer* renderer) {
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(gizmo_size::kMiddleRadius);
  ball->SetThetaResolution(24);
  ball->SetPhiResolution(16);
  return makeActor(ball, renderer);
}

vtkSmartPointer<vtkActor> makeMiddleBox(vtkRenderer* renderer) {
  vtkNew<vtkCubeSource> box;
  box->SetXLength(gizmo_size::kMiddleBox);
  box->SetYLength(gizmo_size::kMiddleBox);
  box->SetZLength(gizmo_size::kMiddleBox);
  return makeActor(box, renderer);
}

const Colour& colourOf(GizmoAxis axis) {
  if (axis == GizmoAxis::kAll) return kOuterRingColour;
  if (axis == GizmoAxis::kGradient) return kGradientColour;
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

GizmoActor::GizmoActor(vtkRenderer* renderer)
    : middle_(makeMiddle(renderer)), middleBox_(makeMiddleBox(renderer)) {
  for (vtkSmartPointer<vtkActor>& arrow : arrows_) arrow = makeArrow(renderer);
  for (vtkSmartPointer<vtkActor>& box : boxes_) box = makeBox(renderer);
}

void GizmoActor::update(const std::optional<Gizmo>& gizmo, const Turntable& camera,
                        double pixelRatio, FlatShapes& shapes) {
  for (const Handles* handles : {&arrows_, &boxes_}) {
    for (vtkActor* handle : *handles) handle->VisibilityOff();
  }
  middle_->VisibilityOff();
  middleBox_->VisibilityOff();
  const auto scale = gizmo ? gizmoScale(*gizmo, camera, pixelRatio) : std::nullopt;
  if (!scale) return;

  const auto shownColour = [&](GizmoAxis axis, const Colour& usual) {
    return axis == gizmo->highlighted ? kHighlightColour : usual;
  };
  if (gizmo->kind == GizmoKind::kRotate) {
    for (const GizmoRing& ring : gizmoRings(*gizmo, camera, pixelRatio)) {
      const bool highlighted = ring.axis == gizmo->highlighted;
      const double width = (highlighted ? 1.5 : 1) * kRingWidth * pixelRatio;
      for (const auto& [a, b] : ring.segments) {
        shapes.addLine(camera.toPixel(a), camera.toPixel(b), width,
                       shownColour(ring.axis, colourOf(ring.axis)));
      }
    }
    return;
  }
  const bool scales = gizmo->kind == GizmoKind::kScale;
  for (const GizmoArrow& arrow : gizmoArrows(*gizmo, camera, pixelRatio)) {
    const auto index = static_cast<std::size_t>(arrow.axis) - 1;
    vtkActor* actor = scales ? boxes_[index] : arrows_[index];
    actor->SetUserMatrix(placed(gizmo->at, arrow.direction, *scale));
    setColour(actor, shownColour(arrow.axis, colourOf(arrow.axis)));
    actor->VisibilityOn();
  }
  vtkActor* middle = scales ? middleBox_ : middle_;
  middle->SetUserMatrix(placed(gizmo->at, Eigen::Vector3d::UnitX(), *scale));
  setColour(middle, shownColour(GizmoAxis::kAll, kMiddleColour));
  middle->VisibilityOn();
}

}  // namespace palpa::view

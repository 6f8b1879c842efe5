#include "app/view/layers/contact_layer.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>

#include "app/view/layers/ring_dashes.h"

namespace palpa::view {
namespace {

using State = ContactRing::State;

constexpr double kRingWidth = 2.6;  // logical pixels
constexpr double kBorderWidth = 5;
constexpr double kBorderOpacity = 0.75;
constexpr double kFaint = 0.30;
/// Amber: no field and no body has this colour.
constexpr Colour kGlass{0.98, 0.76, 0.40};
constexpr Colour kBorderColour{0.06, 0.07, 0.10};

struct RingLook {
  Colour colour;
  int dashes;
  double share;  ///< of the ring that the dashes cover
};

/// The same in both themes: they lie on the surface, on any colour, and have a border.
RingLook lookOf(State state) {
  switch (state) {
    case State::kOpen:
      return {{0.80, 0.83, 0.87}, 20, 0.40};
    case State::kSticking:
      return {{0.42, 0.93, 1.00}, 1, 1};
    case State::kSlipping:
      return {{1.00, 0.66, 0.12}, 14, 0.68};
    case State::kFailed:
      return {{1.00, 0.25, 0.25}, 4, 0.80};
    case State::kGrabbed:
      break;
  }
  return {{1.00, 1.00, 1.00}, 1, 1};
}

vtkSmartPointer<vtkActor> makeRingActor(vtkPolyData* lines, bool isColoured) {
  auto actor = makeLineActor(lines->GetPoints(), vtkSmartPointer<vtkCellArray>::New());
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  mapper->SetInputData(lines);
  mapper->SetScalarVisibility(isColoured);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  // The surface is drawn flat between points that a smooth ring may leave behind it.
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-2, -60);
  actor->VisibilityOff();
  return actor;
}

/// Dense where the ball is seen at a grazing angle.
constexpr const char* kClearMiddle = R"(
float facing = abs(normalVCVSOutput.z);
opacity = mix(0.80, 0.15, smoothstep(0.0, 0.70, facing));
//VTK::Light::Impl
)";

}  // namespace

ContactRings::ContactRings(vtkRenderer* scene, vtkRenderer* shineThrough)
    : points_(makeFloatPoints()),
      colours_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      lines_(vtkSmartPointer<vtkPolyData>::New()) {
  colours_->SetNumberOfComponents(3);
  lines_->SetPoints(points_);
  lines_->GetCellData()->SetScalars(colours_);
  border_ = makeRingActor(lines_, false);
  core_ = makeRingActor(lines_, true);
  faint_ = makeRingActor(lines_, true);
  setColour(border_, kBorderColour);
  border_->GetProperty()->SetOpacity(kBorderOpacity);
  faint_->GetProperty()->SetOpacity(kFaint);
  scene->AddActor(border_);
  scene->AddActor(core_);
  shineThrough->AddActor(faint_);
  setPixelRatio(1);
}

void ContactRings::set(const std::vector<ContactRing>& rings) {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::vector<int>> cells;
  colours_->Reset();
  bounds_ = {};
  for (const ContactRing& ring : rings) {
    const RingLook look = lookOf(ring.state);
    for (const auto& dash : ringDashes(ring.points, look.dashes, look.share)) {
      std::vector<int>& cell = cells.emplace_back();
      for (const Eigen::Vector3d& point : dash) {
        cell.push_back(static_cast<int>(points.size()));
        points.push_back(point);
        bounds_.add(point);
      }
      for (const double value : look.colour)
        colours_->InsertNextValue(static_cast<unsigned char>(std::lround(255 * value)));
    }
  }
  assign(points, points_);
  lines_->SetLines(polylines(cells));
  colours_->Modified();
  lines_->Modified();
  for (vtkActor* actor : {border_.Get(), core_.Get(), faint_.Get()})
    actor->SetVisibility(!cells.empty());
}

void ContactRings::setPixelRatio(double ratio) {
  border_->GetProperty()->SetLineWidth(static_cast<float>(kBorderWidth * ratio));
  core_->GetProperty()->SetLineWidth(static_cast<float>(kRingWidth * ratio));
  faint_->GetProperty()->SetLineWidth(static_cast<float>(kRingWidth * ratio));
}

Balls::Balls(vtkRenderer* scene) : scene_(scene) {
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(40);
  sphere->Update();
  unitSphere_ = sphere->GetOutput();
}

void Balls::add() {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(unitSphere_);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, kClearMiddle,
                                                           false);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.62);
  property->SetDiffuse(0.45);
  property->SetSpecular(0.55);
  property->SetSpecularPower(45);
  property->BackfaceCullingOn();
  blendInOrder(actor);
  setColour(actor, kGlass);
  scene_->AddActor(actor);
  actors_.push_back(actor);
}

void Balls::set(const std::vector<Ball>& balls) {
  balls_ = balls;
  while (actors_.size() < balls.size()) add();
  for (std::size_t i = 0; i < actors_.size(); ++i) actors_[i]->SetVisibility(i < balls.size());
  bounds_ = {};
  for (const Ball& ball : balls) {
    bounds_.add(ball.center - Eigen::Vector3d::Constant(ball.radius));
    bounds_.add(ball.center + Eigen::Vector3d::Constant(ball.radius));
  }
}

void Balls::update(const Turntable& camera) {
  std::sort(balls_.begin(), balls_.end(), [&](const Ball& a, const Ball& b) {
    return camera.depth(a.center) > camera.depth(b.center);
  });
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    const Ball& ball = balls_[i];
    actors_[i]->SetPosition(ball.center.x(), ball.center.y(), ball.center.z());
    actors_[i]->SetScale(ball.radius);
  }
}

}  // namespace palpa::view

#include "app/view/control_net_actor.h"

#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

namespace palpa::view {
namespace {

constexpr double kRim = 2.5;             // pixels by which the rim's diameter exceeds the disc's
constexpr double kHiddenOpacity = 0.22;  // of what the body hides

/// Diameter in pixels.
double sizeOf(HandleState state) {
  switch (state) {
    case HandleState::kHovered:
      return 10.5;
    case HandleState::kSelected:
      return 9;
    case HandleState::kFollowing:
      return 8;
    case HandleState::kPlain:
      break;
  }
  return 6;
}

Colour colourOf(HandleState state, const ViewportTheme& theme) {
  switch (state) {
    case HandleState::kHovered:
      return theme.handleHovered;
    case HandleState::kSelected:
      return theme.handleSelected;
    case HandleState::kFollowing:
      return theme.handleFollowing;
    case HandleState::kPlain:
      break;
  }
  return theme.handle;
}

/// `nearer`: polygon offset units towards the eye, so that discs win over their rims and net lines.
vtkSmartPointer<vtkActor> makePoints(vtkPolyData* data, double nearer, vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-nearer);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetRepresentationToPoints();
  actor->GetProperty()->RenderPointsAsSpheresOn();  // the only round points that VTK has
  actor->GetProperty()->LightingOff();
  renderer->AddActor(actor);
  return actor;
}

}  // namespace

ControlNetActor::ControlNetActor(vtkRenderer* scene, vtkRenderer* shineThrough)
    : points_(makeFloatPoints()) {
  vtkNew<vtkCellArray> none;
  lines_ = makeLineActor(points_, none);
  hiddenLines_ = makeLineActor(points_, none);
  scene->AddActor(lines_);
  shineThrough->AddActor(hiddenLines_);
  for (Handles& handles : handles_) {
    handles.data = vtkSmartPointer<vtkPolyData>::New();
    handles.data->SetPoints(points_);
    handles.rim = makePoints(handles.data, 4, scene);
    handles.disc = makePoints(handles.data, 8, scene);
    handles.hidden = makePoints(handles.data, 0, shineThrough);
  }
  updateLooks();
}

void ControlNetActor::setNet(const ControlNet& net) {
  movePoints(net.points);
  for (vtkActor* lines : {lines_.Get(), hiddenLines_.Get()}) {
    vtkPolyData::SafeDownCast(lines->GetMapper()->GetInput())->SetLines(segments(net.lines));
  }
  setStates(std::vector<HandleState>(net.points.size(), HandleState::kPlain));
}

void ControlNetActor::movePoints(const std::vector<Eigen::Vector3d>& points) {
  assign(points, points_);
}

void ControlNetActor::setStates(const std::vector<HandleState>& states) {
  for (std::size_t k = 0; k < handles_.size(); ++k) {
    vtkNew<vtkCellArray> vertices;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] == static_cast<HandleState>(k)) {
        vertices->InsertNextCell({static_cast<vtkIdType>(i)});
      }
    }
    handles_[k].data->SetVerts(vertices);
  }
}

void ControlNetActor::setVisible(bool visible) {
  lines_->SetVisibility(visible);
  hiddenLines_->SetVisibility(visible);
  for (const Handles& handles : handles_) {
    for (vtkActor* actor : {handles.rim.Get(), handles.disc.Get(), handles.hidden.Get()}) {
      actor->SetVisibility(visible);
    }
  }
}

void ControlNetActor::setTheme(const ViewportTheme& theme) {
  theme_ = theme;
  updateLooks();
}

void ControlNetActor::setPixelRatio(double ratio) {
  pixelRatio_ = ratio;
  updateLooks();
}

void ControlNetActor::updateLooks() {
  for (vtkActor* lines : {lines_.Get(), hiddenLines_.Get()}) {
    setColour(lines, theme_.net);
    lines->GetProperty()->SetLineWidth(static_cast<float>(pixelRatio_));
  }
  lines_->GetProperty()->SetOpacity(0.55);
  hiddenLines_->GetProperty()->SetOpacity(0.6 * kHiddenOpacity);
  for (std::size_t k = 0; k < handles_.size(); ++k) {
    const auto state = static_cast<HandleState>(k);
    const double size = sizeOf(state) * pixelRatio_;
    const Handles& handles = handles_[k];
    handles.disc->GetProperty()->SetPointSize(static_cast<float>(size));
    handles.rim->GetProperty()->SetPointSize(static_cast<float>(size + kRim * pixelRatio_));
    handles.hidden->GetProperty()->SetPointSize(static_cast<float>(size));
    handles.hidden->GetProperty()->SetOpacity(kHiddenOpacity);
    setColour(handles.disc, colourOf(state, theme_));
    setColour(handles.rim, theme_.line);
    // Plain handles are nearly white or black: hidden ones take the colour of the net instead.
    setColour(handles.hidden, state == HandleState::kPlain ? theme_.net : colourOf(state, theme_));
  }
}

}  // namespace palpa::view

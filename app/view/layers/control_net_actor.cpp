#include "app/view/layers/control_net_actor.h"

#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

namespace palpa::view {
namespace {

constexpr double kRim = 1.2;             // logical pixels, width of the rim around a handle
constexpr double kHiddenOpacity = 0.20;  // of handles behind the body

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

/// Square points of VTK, cut to discs with a rim and smooth borders.
vtkSmartPointer<vtkActor> makeDiscs(vtkPolyData* data, vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  // In front of the net lines, and of the surface where it cuts into the disc.
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-160);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  blendInOrder(actor);
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true,
      "//VTK::Light::Impl\n"
      "float fromCenter = 0.5 * size * length(2.0 * gl_PointCoord - 1.0);\n"
      "if (fromCenter >= 0.5 * size) discard;\n"
      "float inside = clamp(0.5 * size - fromCenter, 0.0, 1.0);\n"
      "float inRim = clamp(fromCenter - (0.5 * size - rimWidth) + 0.5, 0.0, 1.0);\n"
      "gl_FragData[0] = vec4(mix(fillColour, rimColour, inRim), opacityUniform * inside);\n",
      false);
  renderer->AddActor(actor);
  return actor;
}

void setLooks(vtkActor* discs, double size, double rim, const Colour& fill, const Colour& edge) {
  discs->GetProperty()->SetPointSize(static_cast<float>(size));
  vtkUniforms* uniforms = discs->GetShaderProperty()->GetFragmentCustomUniforms();
  uniforms->SetUniformf("size", static_cast<float>(size));
  uniforms->SetUniformf("rimWidth", static_cast<float>(rim));
  uniforms->SetUniform3f("fillColour", fill.data());
  uniforms->SetUniform3f("rimColour", edge.data());
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
    handles.shown = makeDiscs(handles.data, scene);
    handles.hidden = makeDiscs(handles.data, shineThrough);
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
    handles.shown->SetVisibility(visible);
    handles.hidden->SetVisibility(visible);
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
    const double size = (sizeOf(state) + 2 * kRim) * pixelRatio_;
    const Colour colour = colourOf(state, theme_);
    setLooks(handles_[k].shown, size, kRim * pixelRatio_, colour, theme_.line);
    // Plain handles are nearly white: behind the body all of the disc takes the colour of the net.
    const Colour faint = state == HandleState::kPlain ? theme_.net : colour;
    setLooks(handles_[k].hidden, size, 0, faint, faint);
    handles_[k].hidden->GetProperty()->SetOpacity(kHiddenOpacity);
  }
}

}  // namespace palpa::view

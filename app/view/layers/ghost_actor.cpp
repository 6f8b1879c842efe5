#include "app/view/layers/ghost_actor.h"

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

namespace palpa::view {
namespace {

constexpr Colour kOnDark{0.92, 0.94, 0.98};
constexpr Colour kOnWhite{0.13, 0.15, 0.20};

constexpr const char* kGhostRim = R"(
float facing = abs(normalVCVSOutput.z);
opacity = mix(0.70, 0.16, smoothstep(0.0, 0.45, facing));
//VTK::Light::Impl
)";

/// Behind everything. The vertices move, not the pixels: so the depth test discards pixels behind
/// the body before their colours are computed.
constexpr const char* kFarthest =
    "gl_Position.z = 0.99999 * gl_Position.w;\n"
    "//VTK::Light::Impl\n";

// Without lines of the far side, which would confuse.
constexpr const char* kDeclareFacing = R"(//VTK::Normal::Dec
in vec3 outwardsMC;
out float facingVSOutput;
)";
constexpr const char* kFacing = R"(//VTK::Normal::Impl
facingVSOutput = dot(outwardsMC, parallelView > 0.5 ? -forward : eye - vertexMC.xyz);
)";
constexpr const char* kDeclareTurned = "//VTK::Normal::Dec\nin float facingVSOutput;\n";
constexpr const char* kDiscardTurned = "//VTK::Color::Impl\nif (facingVSOutput < 0.0) discard;\n";

}  // namespace

GhostSide::GhostSide(vtkRenderer* scene) : surface_(scene, {kGhostRim, kFarthest, 0.6, 0.4}) {}

void GhostSide::setTheme(const ViewportTheme& theme) {
  surface_.setColour(mixed(theme.net, theme.body, 0.3));
}

GhostLines::GhostLines(vtkRenderer* scene, vtkRenderer* shineThrough)
    : points_(makeFloatPoints()), outwards_(vtkSmartPointer<vtkFloatArray>::New()) {
  outwards_->SetNumberOfComponents(3);
  outwards_->SetName("outwards");
  for (std::size_t k = 0; k < 2; ++k) {
    for (auto* lines : {&borders_, &knotLines_}) {
      vtkNew<vtkCellArray> none;
      vtkSmartPointer<vtkActor>& actor = (*lines)[k];
      actor = makeLineActor(points_, none);
      // Where nothing moved, the body's own lines cover these.
      actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0, 0);
      actor->VisibilityOff();
      (k == 0 ? scene : shineThrough)->AddActor(actor);
    }
  }
  for (vtkActor* actor : {borders_[1].Get(), knotLines_[1].Get()}) {
    vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput())->GetPointData()->AddArray(outwards_);
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    mapper->MapDataArrayToVertexAttribute("outwardsMC", "outwards",
                                          vtkDataObject::FIELD_ASSOCIATION_POINTS);
    vtkShaderProperty* shader = actor->GetShaderProperty();
    shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, kDeclareFacing, false);
    shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, kFacing, false);
    shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, kDeclareTurned, false);
    shader->AddFragmentShaderReplacement("//VTK::Color::Impl", true, kDiscardTurned, false);
  }
  borders_[0]->GetProperty()->SetOpacity(0.85);
  borders_[1]->GetProperty()->SetOpacity(0.34);
  knotLines_[0]->GetProperty()->SetOpacity(0.40);
  knotLines_[1]->GetProperty()->SetOpacity(0.18);
}

void GhostLines::set(const ViewportBody& body) {
  assign(body.positions, points_);
  assign(body.normals, outwards_);
  bounds_ = {};
  for (const Eigen::Vector3d& position : body.positions) bounds_.add(position);
  const auto borders = distinctLines(body.borders, body.positions);
  for (vtkActor* actor : borders_) showLines(actor, borders);
  for (vtkActor* actor : knotLines_) showLines(actor, body.knotLines);
}

void GhostLines::setTheme(const ViewportTheme& theme,
                          const std::optional<ScalarField::Colours>& field) {
  // Most of a body hardly moves: it is dark in sequential colours and white in diverging ones.
  Colour onBody = theme.net;
  if (field) onBody = *field == ScalarField::Colours::kSequential ? kOnDark : kOnWhite;
  for (const auto* lines : {&borders_, &knotLines_}) {
    setColour((*lines)[0], theme.net);
    setColour((*lines)[1], onBody);
  }
}

void GhostLines::update(const Turntable& camera) {
  for (vtkActor* actor : {borders_[1].Get(), knotLines_[1].Get()}) {
    vtkUniforms* uniforms = actor->GetShaderProperty()->GetVertexCustomUniforms();
    uniforms->SetUniform3f("eye", camera.eye().data());
    uniforms->SetUniform3f("forward", camera.axes().forward.data());
    uniforms->SetUniformf("parallelView", camera.parallel() ? 1.0F : 0.0F);
  }
}

void GhostLines::setPixelRatio(double ratio) {
  for (std::size_t k = 0; k < 2; ++k) {
    borders_[k]->GetProperty()->SetLineWidth(static_cast<float>(1.4 * ratio));
    knotLines_[k]->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  }
}

}  // namespace palpa::view

#include "app/view/layers/compared_body.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

namespace palpa::view {
namespace {

/// Colours of a field below it stay readable where the surface faces the eye.
constexpr const char* kDenseRim = R"(
float facing = abs(normalVCVSOutput.z);
opacity = mix(0.78, 0.24, smoothstep(0.0, 0.5, facing));
//VTK::Light::Impl
)";

constexpr double kBorderOpacity = 0.95, kHiddenOpacity = 0.35, kBorderWidth = 1.6;

/// Pushed back a little: where both bodies coincide the body is visible, without a pattern of
/// rounding errors.
constexpr const char* kBehindCoincident =
    "gl_Position.z += 0.002 * gl_Position.w;\n"
    "//VTK::Light::Impl\n";

}  // namespace

ComparedBody::ComparedBody(vtkRenderer* scene, vtkRenderer* shineThrough)
    : points_(makeFloatPoints()),
      normals_(vtkSmartPointer<vtkFloatArray>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()),
      actor_(vtkSmartPointer<vtkActor>::New()) {
  normals_->SetNumberOfComponents(3);
  surface_->SetPoints(points_);
  surface_->GetPointData()->SetNormals(normals_);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface_);
  actor_->SetMapper(mapper);
  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, kDenseRim, false);
  shader->AddVertexShaderReplacement("//VTK::Light::Impl", true, kBehindCoincident, false);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(0.55);
  property->SetDiffuse(0.45);
  property->BackfaceCullingOn();
  blendInOrder(actor_);
  setColour(actor_, kComparedColour);
  actor_->VisibilityOff();
  scene->AddActor(actor_);
  for (std::size_t k = 0; k < borders_.size(); ++k) {
    vtkNew<vtkCellArray> none;
    borders_[k] = makeLineActor(points_, none);
    borders_[k]->GetProperty()->SetOpacity(k == 0 ? kBorderOpacity : kHiddenOpacity);
    borders_[k]->VisibilityOff();
    setColour(borders_[k], kComparedColour);
    (k == 0 ? scene : shineThrough)->AddActor(borders_[k]);
  }
}

void ComparedBody::set(const ViewportBody& body) {
  size_ = body.positions.size();
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : body.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  surface_->SetPolys(triangles);
  const auto lines = distinctLines(body.borders, body.positions);
  for (vtkActor* actor : borders_) {
    vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput())->SetLines(polylines(lines));
    actor->SetVisibility(!lines.empty());
  }
  actor_->SetVisibility(!body.triangles.empty());
  move(body.positions, body.normals);
}

void ComparedBody::move(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  assign(positions, points_);
  assign(normals, normals_);
  surface_->Modified();
  bounds_ = {};
  for (const Eigen::Vector3d& position : positions) bounds_.add(position);
}

void ComparedBody::setPixelRatio(double ratio) {
  for (vtkActor* actor : borders_)
    actor->GetProperty()->SetLineWidth(static_cast<float>(kBorderWidth * ratio));
}

}  // namespace palpa::view

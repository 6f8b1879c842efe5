#include "app/view/layers/rim_surface.h"

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>

namespace palpa::view {

RimSurface::RimSurface(vtkRenderer* scene, const Look& look)
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
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, look.opacity, false);
  shader->AddVertexShaderReplacement("//VTK::Light::Impl", true, look.depth, false);
  vtkProperty* property = actor_->GetProperty();
  property->SetInterpolationToPhong();
  property->SetAmbient(look.ambient);
  property->SetDiffuse(look.diffuse);
  property->BackfaceCullingOn();
  blendInOrder(actor_);
  actor_->VisibilityOff();
  scene->AddActor(actor_);
}

void RimSurface::set(const ViewportBody& body) {
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : body.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  surface_->SetPolys(triangles);
  actor_->SetVisibility(!body.triangles.empty());
  move(body.positions, body.normals);
}

void RimSurface::move(const std::vector<Eigen::Vector3d>& positions,
                      const std::vector<Eigen::Vector3d>& normals) {
  assign(positions, points_);
  assign(normals, normals_);
  surface_->Modified();
}

void RimSurface::setColour(const Colour& colour) {
  view::setColour(actor_, colour);
}

}  // namespace palpa::view

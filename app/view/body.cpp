#include "app/view/body.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataSilhouette.h>
#include <vtkProperty.h>

#include "app/view/colour_map.h"
#include "app/view/geometry.h"

namespace palpa::view {
namespace {

/// Surfaces are pushed back behind lines by this polygon offset.
constexpr double kSurfaceOffset = 1;
constexpr double kGhostOpacity = 0.22;

vtkSmartPointer<vtkActor> addSurface(vtkPolyData* surface, const Colour& colour, double offset,
                                     vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->ScalarVisibilityOff();
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(offset, offset);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetInterpolationToPhong();
  property->SetAmbient(0.36);
  property->SetDiffuse(0.70);
  property->SetSpecular(0.08);
  property->SetSpecularPower(14);
  renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> makeLines(vtkPolyDataMapper* mapper, const Colour& colour, double opacity,
                                    double width) {
  mapper->ScalarVisibilityOff();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-kSurfaceOffset, -kSurfaceOffset);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetColor(colour[0], colour[1], colour[2]);
  property->SetOpacity(opacity);
  property->SetLineWidth(static_cast<float>(width));
  property->LightingOff();
  return actor;
}

void addLines(vtkPolyData* lines, const Colour& colour, double opacity, double width,
              vtkRenderer* renderer) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines);
  renderer->AddActor(makeLines(mapper, colour, opacity, width));
}

void addSilhouette(vtkPolyData* surface, const Colour& colour, double opacity, double width,
                   vtkRenderer* renderer) {
  vtkNew<vtkPolyDataSilhouette> silhouette;
  silhouette->SetInputData(surface);
  silhouette->SetCamera(renderer->GetActiveCamera());
  silhouette->SetEnableFeatureAngle(0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(silhouette->GetOutputPort());
  renderer->AddActor(makeLines(mapper, colour, opacity, width));
}

/// The undeformed shape's lines, hidden by the body where they lie behind it.
void addGhostLines(vtkPolyData* reference, double creaseAngle, vtkRenderer* renderer,
                   double pixel) {
  addSilhouette(reference, kGhostColour, 0.9, 1.2 * pixel, renderer);
  addLines(creaseLines(reference, creaseAngle), kGhostColour, 0.7, 1.1 * pixel, renderer);
}

std::vector<int> freeTriangles(const SurfaceScene& scene) {
  std::vector<bool> held(scene.triangles.size(), false);
  for (const int triangle : scene.supports) held[static_cast<std::size_t>(triangle)] = true;
  std::vector<int> free;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!held[i]) free.push_back(static_cast<int>(i));
  }
  return free;
}

}  // namespace

void addBody(const SurfaceScene& scene, vtkRenderer* renderer, double pixel) {
  const auto reference = referenceSurface(scene);
  const auto surface = scene.normals.empty() ? deformedWithNormals(reference, scene.creaseAngle)
                                             : deformedWithNormals(reference, scene.normals);
  const auto whole = scene.normals.empty() ? reference : merged(reference);

  const auto body =
      addSurface(subset(surface, freeTriangles(scene)), kBodyColour, kSurfaceOffset, renderer);
  if (scene.field) {
    vtkMapper* mapper = body->GetMapper();
    mapper->ScalarVisibilityOn();
    mapper->SetScalarModeToUsePointData();
    mapper->SetLookupTable(colourMap(*scene.field));
    mapper->UseLookupTableScalarRangeOn();
    mapper->InterpolateScalarsBeforeMappingOn();
  }
  if (!scene.supports.empty()) {
    addSurface(subset(surface, scene.supports), kSupportColour, kSurfaceOffset, renderer);
    addLines(deform(borderLines(whole, scene.supports)), kLineColour, 0.8, 1.6 * pixel, renderer);
  }
  if (scene.showMeshEdges) {
    addLines(
        deform(scene.meshLines.empty() ? meshLines(whole) : meshLines(reference, scene.meshLines)),
        kLineColour, 0.32, 0.8 * pixel, renderer);
  }
  addLines(deform(creaseLines(whole, scene.creaseAngle)), kLineColour, 0.55, 1.3 * pixel, renderer);
  addSilhouette(deform(whole), kLineColour, 0.55, 1.3 * pixel, renderer);
  for (const ContactPatch& patch : scene.contactPatches) {
    addLines(deform(contactLines(whole, patch)), kAppliedForceColour, 1, 2.2 * pixel, renderer);
  }
  if (scene.showUndeformed) addGhostLines(whole, scene.creaseAngle, renderer, pixel);
}

void addGhost(const SurfaceScene& scene, vtkRenderer* background) {
  const auto surface = undeformedWithNormals(referenceSurface(scene), scene.creaseAngle);
  const auto actor = addSurface(surface, kGhostColour, 0, background);
  actor->GetProperty()->SetOpacity(kGhostOpacity);
  // Only the near side: the ghost is then one layer thick and needs no sorting.
  actor->GetProperty()->BackfaceCullingOn();
}

void addLights(vtkRenderer* renderer) {
  renderer->RemoveAllLights();
  renderer->AutomaticLightCreationOff();
  const auto add = [renderer](double x, double y, double intensity) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, 1);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer->AddLight(light);
  };
  add(-0.60, 0.65, 0.85);
  add(0.30, -0.5, 0.36);
}

}  // namespace palpa::view

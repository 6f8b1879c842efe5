#include "app/view/viewport/parts.h"

#include <vtkLight.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/view/layers/mark_colours.h"
#include "app/view/layers/text.h"
#include "app/view/viewport/checks.h"

namespace palpa::view {
namespace {

constexpr double kFallbackDiagonal = 100;  // mm, where there is no body

/// A key light from the upper left of the camera and a soft fill from the right.
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

}  // namespace

Viewport::Parts::Parts(vtkRenderWindow* renderWindow, double ratio)
    : window(renderWindow),
      pixelRatio(ratio),
      restDiagonal(kFallbackDiagonal),
      shapes(shineThrough),
      surface(scene),
      sectionFace(scene),
      standInSurface(scene),
      ghostSide(scene),
      grid(scene),
      netActor(scene, shineThrough),
      ghostLines(scene, shineThrough),
      compared(scene, shineThrough),
      arrows(scene, shineThrough, overlay),
      rings(scene, shineThrough),
      liveArrows(scene, shineThrough, overlay),
      gradientArrows(scene, shineThrough, overlay),
      tool(scene, overlay),
      touchLayer(overlay),
      sampleLayer(overlay),
      dimensionLayer(overlay),
      signs(overlay),
      axes(overlay),
      viewCube(overlay),
      gizmoActor(overlay),
      colourBar(overlay),
      captionLayer(overlay),
      balls(scene) {
  window->SetMultiSamples(0);  // in software four samples take three times as long
  window->SetDPI(72);          // a point of a font is a pixel
  window->SetNumberOfLayers(3);
  int layer = 0;
  for (vtkRenderer* renderer : {scene.Get(), shineThrough.Get(), overlay.Get()}) {
    renderer->SetLayer(layer++);
    renderer->SetActiveCamera(vtkView);
    addLights(renderer);
    window->AddRenderer(renderer);
  }
  scene->GradientBackgroundOn();
  // VTK skips a renderer without visible actors, and with it the smoothing of everything below.
  overlay->AddActor2D(makeText(" ", {}));
}

Viewport::Parts::~Parts() {
  for (vtkRenderer* renderer : {scene.Get(), shineThrough.Get(), overlay.Get()}) {
    window->RemoveRenderer(renderer);
  }
}

void Viewport::Parts::syncSize() {
  const int* size = window->GetSize();
  camera.setSize(static_cast<int>(std::lround(size[0] / resolution)),
                 static_cast<int>(std::lround(size[1] / resolution)));
}

void Viewport::Parts::syncBounds() {
  bodyBounds = {};
  for (const Eigen::Vector3d& point : body.positions) bodyBounds.add(point);
  netBounds = {};
  for (const Eigen::Vector3d& point : net.points) netBounds.add(point);
  Bounds all = bodyBounds;
  all.add(netBounds);
  camera.setScene(all);
}

void Viewport::Parts::remakeArrows() {
  arrows.set(forces, bodyDiagonal(), theme, pixelRatio);
}

void Viewport::Parts::remakeLiveArrows() {
  liveArrows.set(liveForces, restDiagonal, theme, pixelRatio);
}

void Viewport::Parts::remakeGradientArrows() {
  gradientArrows.set(gradient, restDiagonal, theme, pixelRatio);
}

void Viewport::Parts::applyField() {
  colourBar.set(field, theme, pixelRatio);
  ghostLines.setTheme(theme, field ? std::optional(field->colours) : std::nullopt);
  remakeCaption();
}

void Viewport::Parts::remakeCaption() {
  const SupportColours colours = supportColours(theme, field.has_value());
  Caption all = caption;
  all.lines.insert(all.lines.begin(), gradient.legend.begin(), gradient.legend.end());
  captionLayer.set(all, theme, colours.ground, colours.stroke, pixelRatio);
}

void Viewport::Parts::remakeWarnings() {
  signs.set(warnings, theme, pixelRatio);
}

void Viewport::Parts::remakeTouches() {
  touchLayer.set(touches, theme, pixelRatio);
}

void Viewport::Parts::remakeTool() {
  tool.set(toolDrawing, theme, pixelRatio);
}

void Viewport::Parts::remakeSamples() {
  sampleLayer.set(samples, theme, pixelRatio);
}

void Viewport::Parts::remakeDimensions() {
  dimensionLayer.set(dimensions, theme, pixelRatio);
}

void Viewport::Parts::applyTheme() {
  scene->SetBackground(theme.backgroundBottom.data());
  scene->SetBackground2(theme.backgroundTop.data());
  grid.setTheme(theme);
  surface.setTheme(theme);
  sectionFace.setTheme(theme);
  standInSurface.setTheme(theme);
  netActor.setTheme(theme);
  viewCube.setTheme(theme, pixelRatio);
  ghostSide.setTheme(theme);
  remakeArrows();
  remakeLiveArrows();
  remakeGradientArrows();
  applyField();
  remakeWarnings();
  remakeTouches();
  remakeTool();
  remakeSamples();
  remakeDimensions();
}

void Viewport::Parts::applyCamera() {
  balls.update(camera);
  Bounds all = bodyBounds;
  all.add(netBounds);
  for (const Eigen::Vector3d& point : arrows.ends()) all.add(point);
  for (const Eigen::Vector3d& point : liveArrows.ends()) all.add(point);
  for (const Eigen::Vector3d& point : gradientArrows.ends()) all.add(point);
  if (standIn)
    for (const Eigen::Vector3d& point : standIn->positions) all.add(point);
  for (const Bounds& part :
       {ghostLines.bounds(), compared.bounds(), rings.bounds(), balls.bounds()})
    all.add(part);
  for (const Eigen::Vector3d& point : tool.ends()) all.add(point);
  // The ground fades out at one visible height from the focus.
  const Eigen::Vector3d reach = Eigen::Vector3d(1, 1, 0) * camera.visibleHeight();
  Eigen::Vector3d middle = camera.focus();
  middle.z() = groundLevel(bodyBounds);
  all.add(middle - reach);
  all.add(middle + reach);
  if (const auto shown = shownGizmo(pixelRatio)) {
    for (const GizmoArrow& arrow : gizmoArrows(*shown, camera, pixelRatio)) all.add(arrow.end);
  }

  const Eigen::Vector3d eye = camera.eye();
  const std::array<double, 2> range = camera.clippingRange(all);
  vtkView->SetPosition(eye.data());
  vtkView->SetFocalPoint(camera.focus().data());
  vtkView->SetViewUp(camera.axes().up.data());
  vtkView->SetViewAngle(kVerticalViewAngle * 180 / std::numbers::pi);
  vtkView->SetParallelProjection(camera.parallel());
  vtkView->SetParallelScale(0.5 * camera.visibleHeight());
  vtkView->SetClippingRange(range[0], range[1]);
}

void Viewport::Parts::look(const CameraView& view, const std::vector<Eigen::Vector3d>& points,
                           const Reserve& reserve) {
  require(view.direction.norm() > 0 && view.zoom > 0, "a camera needs a direction and a zoom > 0");
  camera.setDirection(view.direction, view.up);
  camera.setParallel(view.parallel);
  syncSize();
  camera.fit(points, fitMargin(), reserve);
  camera.setDistance(camera.distance() / view.zoom);
}

void Viewport::Parts::updateOverlay() {
  shapes.clear(camera.height());
  axes.update(camera, shapes);
  viewCube.update(camera, shapes);
  std::vector<PixelBox> taken;
  Reserve reserve = captionLayer.reserve(camera.width());
  if (viewCube.isVisible()) {
    const double side = kViewCubeSide * pixelRatio;
    taken.push_back({{camera.width() - side, 0}, {static_cast<double>(camera.width()), side}});
    reserve.top = std::max(reserve.top, side);
  }
  colourBar.update(camera, reserve, taken, shapes);
  captionLayer.update(camera, taken, shapes);
  arrows.update(camera, taken, shapes);
  liveArrows.update(camera, taken, shapes);
  gradientArrows.update(camera, taken, shapes);
  const std::optional<Gizmo> shown = shownGizmo(pixelRatio);
  // From a gizmo that was moved into the picture to its place.
  if (shown && shown->at != gizmo->at)
    shapes.addLine(camera.toPixel(gizmo->at), camera.toPixel(shown->at), 1.2 * pixelRatio,
                   theme.text, 0.6);
  gizmoActor.update(shown, camera, pixelRatio, shapes);
  touchLayer.update(
      camera, [this](const Eigen::Vector3d& point) { return hidden(point); }, shapes);
  tool.update(camera, shapes);
  signs.update(camera, shapes);
  dimensionLayer.update(camera, bodyBounds.empty() ? camera.focus() : bodyBounds.center(), taken,
                        shapes);
  sampleLayer.update(
      camera, [this](const Eigen::Vector3d& point) { return hidden(point); }, taken, shapes);
  if (rubberBand) {
    const Eigen::Vector2d a = resolution * (*rubberBand)[0];
    const Eigen::Vector2d b = resolution * (*rubberBand)[1];
    shapes.addRectangle(a, b, theme.selected, 0.12);
    shapes.addFrame(a, b, std::max(1.0, std::round(pixelRatio)), theme.selected, 0.9);
  }
  shapes.finish();
}

std::optional<Gizmo> Viewport::Parts::shownGizmo(double ratio) const {
  if (!gizmo) return std::nullopt;
  return gizmoInPicture(*gizmo, camera, ratio);
}

std::vector<Eigen::Vector3d> Viewport::Parts::shownPoints() const {
  std::vector<Eigen::Vector3d> points = body.positions;
  if (netVisible) points.insert(points.end(), net.points.begin(), net.points.end());
  points.insert(points.end(), arrows.ends().begin(), arrows.ends().end());
  if (standIn) points.insert(points.end(), standIn->positions.begin(), standIn->positions.end());
  if (!compared.bounds().empty())
    for (const Eigen::Vector3d& corner : compared.bounds().corners()) points.push_back(corner);
  return points;
}

double Viewport::Parts::fitMargin() const {
  return 0.09 * std::min(camera.width(), camera.height());
}

Reserve Viewport::Parts::fitReserve(bool withWords) {
  Reserve reserve = captionLayer.reserve(static_cast<int>(camera.width() * resolution));
  reserve.right = colourBar.reach(camera.height() * resolution, reserve, withWords);
  return {reserve.right / resolution, reserve.top / resolution, reserve.bottom / resolution};
}

double Viewport::Parts::bodyDiagonal() const {
  const double diagonal = bodyBounds.empty() ? 0 : bodyBounds.size().norm();
  return diagonal > 0 ? diagonal : kFallbackDiagonal;
}

}  // namespace palpa::view

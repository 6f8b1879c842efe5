#include "app/view/viewport/viewport.h"

#include "app/view/files/png.h"
#include "app/view/viewport/checks.h"
#include "app/view/viewport/parts.h"

namespace palpa::view {

Viewport::Viewport(vtkRenderWindow* window, double pixelRatio)
    : parts_(std::make_unique<Parts>(window, pixelRatio)) {
  setTheme(ViewportTheme::light());
  setPixelRatio(pixelRatio);
}

Viewport::~Viewport() = default;

void Viewport::setTheme(const ViewportTheme& theme) {
  parts_->theme = theme;
  parts_->applyTheme();
}

void Viewport::setPixelRatio(double ratio) {
  require(ratio > 0 && ratio <= 16, "the pixel ratio is between 0 and 16");
  ratio *= parts_->resolution;
  parts_->pixelRatio = ratio;
  parts_->grid.setPixelRatio(ratio);
  parts_->surface.setPixelRatio(ratio);
  parts_->sectionFace.setPixelRatio(ratio);
  parts_->standInSurface.setPixelRatio(ratio);
  parts_->netActor.setPixelRatio(ratio);
  parts_->axes.setPixelRatio(ratio);
  parts_->ghostLines.setPixelRatio(ratio);
  parts_->compared.setPixelRatio(ratio);
  parts_->rings.setPixelRatio(ratio);
  parts_->viewCube.setTheme(parts_->theme, ratio);
  parts_->remakeArrows();
  parts_->remakeLiveArrows();
  parts_->remakeGradientArrows();
  parts_->applyField();
  parts_->remakeWarnings();
  parts_->remakeTouches();
  parts_->remakeTool();
  parts_->remakeSamples();
  parts_->remakeDimensions();
}

double Viewport::pixelRatio() const {
  return parts_->inputRatio();
}

void Viewport::setResolution(double share) {
  require(share >= 0.1 && share <= 1, "the resolution is between 0.1 and 1");
  if (share == parts_->resolution) return;
  const double ratio = parts_->inputRatio();
  parts_->resolution = share;
  setPixelRatio(ratio);
}

double Viewport::resolution() const {
  return parts_->resolution;
}

void Viewport::setShading(Shading shading) {
  parts_->surface.setShading(shading);
  // A section without its fill would show nothing.
  parts_->sectionFace.setShading(shading == Shading::kWire ? Shading::kShadedWithEdges : shading);
}

void Viewport::setGridVisible(bool visible) {
  parts_->grid.setVisible(visible);
}

void Viewport::setRegionsVisible(bool visible) {
  parts_->surface.setRegionsVisible(visible);
  parts_->arrows.setVisible(visible);
}

void Viewport::setTouchesVisible(bool visible) {
  parts_->touchLayer.setVisible(visible);
}

void Viewport::setWarningsVisible(bool visible) {
  parts_->signs.setVisible(visible);
}

void Viewport::setDimensions(const std::vector<Dimension>& dimensions) {
  parts_->dimensions = dimensions;
  parts_->remakeDimensions();
}

void Viewport::setDimensionsVisible(bool visible) {
  parts_->dimensionLayer.setVisible(visible);
}

std::optional<int> Viewport::dimensionAt(const Eigen::Vector2d& pixel) const {
  return parts_->dimensionLayer.at(parts_->resolution * pixel);
}

void Viewport::setAxesVisible(bool visible) {
  parts_->axes.setVisible(visible);
}

void Viewport::setViewCubeVisible(bool visible) {
  parts_->viewCube.setVisible(visible);
}

bool Viewport::isViewCubeVisible() const {
  return parts_->viewCube.isVisible();
}

void Viewport::setHoveredCubePart(const std::optional<ViewCubePart>& part) {
  parts_->viewCube.setHovered(part);
}

void Viewport::setControlNetVisible(bool visible) {
  parts_->netVisible = visible;
  parts_->netActor.setVisible(visible);
}

void Viewport::setBody(const ViewportBody& body) {
  requireValidBody(body);
  parts_->body = body;
  parts_->bodyBoxes.set(body.positions, body.triangles);
  parts_->surface.setBody(body);
  setSection(std::nullopt);
  parts_->field.reset();
  parts_->syncBounds();
  parts_->restDiagonal = parts_->bodyDiagonal();
  parts_->remakeArrows();
  parts_->remakeLiveArrows();
  parts_->remakeGradientArrows();
  parts_->applyField();
}

void Viewport::moveBody(const std::vector<Eigen::Vector3d>& positions,
                        const std::vector<Eigen::Vector3d>& normals) {
  require(positions.size() == parts_->body.positions.size() && normals.size() == positions.size(),
          "a moved body has as many points and normals as before");
  parts_->body.positions = positions;
  parts_->body.normals = normals;
  parts_->bodyBoxes.move();
  parts_->surface.move(positions, normals);
  parts_->syncBounds();
}

void Viewport::setMarks(const std::vector<Mark>& marks) {
  require(marks.size() == parts_->body.triangles.size(), "marks need one entry per triangle");
  parts_->surface.setMarks(marks);
}

void Viewport::setControlNet(const ControlNet& net) {
  const int pointCount = static_cast<int>(net.points.size());
  for (const std::array<int, 2>& line : net.lines) {
    for (const int end : line) {
      require(end >= 0 && end < pointCount, "a net line names a point that does not exist");
    }
  }
  parts_->net = net;
  parts_->netActor.setNet(net);
  parts_->syncBounds();
}

void Viewport::moveControlPoints(const std::vector<Eigen::Vector3d>& points) {
  require(points.size() == parts_->net.points.size(), "a moved net has as many points as before");
  parts_->net.points = points;
  parts_->netActor.movePoints(points);
  parts_->syncBounds();
}

void Viewport::setHandleStates(const std::vector<HandleState>& states) {
  require(states.size() == parts_->net.points.size(),
          "handle states need one entry per control point");
  parts_->netActor.setStates(states);
}

void Viewport::setLoadArrows(const std::vector<ForceArrow>& arrows) {
  parts_->forces = arrows;
  parts_->remakeArrows();
}

void Viewport::setWarnings(const std::vector<WarningMarker>& warnings) {
  parts_->warnings = warnings;
  parts_->remakeWarnings();
}

void Viewport::setGizmo(const std::optional<Gizmo>& gizmo) {
  parts_->gizmo = gizmo;
}

void Viewport::setTouchMarkers(const std::vector<TouchMarker>& markers) {
  parts_->touches = markers;
  parts_->remakeTouches();
}

void Viewport::setToolDrawing(const ToolDrawing& drawing) {
  parts_->toolDrawing = drawing;
  parts_->remakeTool();
}

void Viewport::setRegions(const std::vector<double>& supports, const std::vector<double>& loads,
                          const std::vector<double>& conflict) {
  const auto fits = [&](const std::vector<double>& field) {
    return field.empty() || field.size() == parts_->body.positions.size();
  };
  require(fits(supports) && fits(loads) && fits(conflict), "regions need one number per point");
  parts_->surface.setRegions(supports, loads, conflict);
}

void Viewport::setRubberBand(const std::optional<std::array<Eigen::Vector2d, 2>>& corners) {
  parts_->rubberBand = corners;
}

void Viewport::warmUp() {
  Parts& parts = *parts_;
  std::vector<HandleState> states(parts.net.points.size(), HandleState::kPlain);
  for (std::size_t i = 0; i < states.size() && i < 4; ++i) states[i] = static_cast<HandleState>(i);
  parts.netActor.setStates(states);
  const std::optional<Gizmo> gizmo = parts.gizmo;
  parts.gizmo.emplace().at = parts.camera.focus();
  render(Quality::kQuick);
  parts.gizmo = gizmo;
  parts.netActor.setStates(std::vector<HandleState>(states.size(), HandleState::kPlain));
}

void Viewport::render(Quality quality) {
  Parts& parts = *parts_;
  const int* size = parts.window->GetSize();
  if (size[0] < 1 || size[1] < 1) return;
  parts.camera.setSize(size[0], size[1]);
  parts.applyCamera();
  parts.grid.update(parts.camera, groundLevel(parts.bodyBounds));
  parts.surface.setScale(parts.pixelRatio * parts.camera.visibleHeight() / parts.camera.height());
  parts.ghostLines.update(parts.camera);
  for (SurfaceActor* surface : {&parts.surface, &parts.standInSurface})
    surface->setCoarse(quality == Quality::kMoving);
  parts.updateOverlay();
  parts.overlay->SetUseFXAA(quality == Quality::kFine);
  parts.window->Render();
  parts.syncSize();
}

std::size_t Viewport::drawnTriangles() const {
  return parts_->surface.drawnTriangles();
}

void Viewport::writePng(const std::filesystem::path& path) {
  render();
  view::writePng(parts_->window, path);
}

}  // namespace palpa::view

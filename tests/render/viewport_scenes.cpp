#include "tests/render/viewport_scenes.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <Eigen/Geometry>

#include "modeling/shapes/primitives.h"
#include "modeling/solid/tessellation.h"

namespace palpa::render_tests {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using modeling::Solid;
using view::ControlNet;
using view::ForceArrow;
using view::HandleState;
using view::Mark;
using view::Viewport;
using view::ViewportBody;

void show(const Solid& solid, Viewport& viewport) {
  viewport.setBody(viewportBody(solid));
  viewport.setControlNet(controlNet(solid));
  viewport.fit();
}

/// Marks whole patches.
std::vector<Mark> marks(const Solid& solid, const std::map<std::string, Mark>& patches) {
  std::vector<Mark> marks;
  for (const int patch : viewportBody(solid).patchOfTriangle) {
    const auto found = patches.find(solid.patches()[static_cast<std::size_t>(patch)].name);
    marks.push_back(found == patches.end() ? Mark::kNone : found->second);
  }
  return marks;
}

/// The control point nearest to a place.
std::size_t nearest(const Solid& solid, const Vector3d& place) {
  std::size_t best = 0;
  const auto& points = solid.controlPoints();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - place).norm() < (points[best] - place).norm()) best = i;
  }
  return best;
}

/// A sphere with one point pulled out: selected, its neighbours following, and a gizmo on it.
void selection(Viewport& viewport) {
  const Solid sphere = modeling::makeSphere(25);
  std::vector<Vector3d> points = sphere.controlPoints();
  const Vector3d normal = Vector3d(0.55, -0.65, 0.5).normalized();
  const std::size_t moved = nearest(sphere, 25 * normal);
  std::vector<HandleState> states(points.size(), HandleState::kPlain);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double distance = (sphere.controlPoints()[i] - sphere.controlPoints()[moved]).norm();
    if (distance < 11) {
      states[i] = HandleState::kFollowing;
      points[i] += 3 * normal;
    }
  }
  states[moved] = HandleState::kSelected;
  points[moved] += 3 * normal;
  const Solid bulged = sphere.withControlPoints(points);
  show(sphere, viewport);
  const modeling::Tessellation tessellation(sphere);
  const auto shape = tessellation.evaluate(points);
  viewport.moveBody(shape.positions, shape.normals);
  viewport.moveControlPoints(points);
  viewport.setHandleStates(states);
  viewport.setGizmo(view::Gizmo{points[moved], normal, view::GizmoAxis::kX});
}

void rubberBand(Viewport& viewport) {
  const Solid box = modeling::makeBox({40, 30, 20});
  show(box, viewport);
  const Vector2d a(250, 120);
  const Vector2d b(520, 330);
  std::vector<HandleState> states(box.controlPoints().size(), HandleState::kPlain);
  for (const int point : viewport.controlPointsIn(a, b)) {
    states[static_cast<std::size_t>(point)] = HandleState::kSelected;
  }
  viewport.setHandleStates(states);
  viewport.setRubberBand(std::array<Vector2d, 2>{a, b});
}

void boundaryConditions(Viewport& viewport) {
  const Solid box = modeling::makeBox({60, 30, 20});
  show(box, viewport);
  viewport.setControlNetVisible(false);
  viewport.setMarks(marks(box, {{"side_xmin", Mark::kSupport},
                                {"side_xmax", Mark::kLoad},
                                {"side_ymin", Mark::kSelected},
                                {"top", Mark::kHovered}}));
  viewport.setLoadArrows({{{30, -8, 10}, {0, 0, -2}, ForceArrow::Anchor::kTail, {}, "2.00 N"},
                          {{30, 8, 10}, {0, 0, -1}, ForceArrow::Anchor::kTail, {}, "1.00 N"},
                          {{0, 0, 20}, {0, 0, -1.5}, ForceArrow::Anchor::kTip, {}, "1.50 N"},
                          {{-30, 0, 10},
                           {0, 0, 1.5},
                           ForceArrow::Anchor::kTip,
                           ForceArrow::Role::kReaction,
                           "4.50 N"}});
  viewport.lookFrom(view::StandardView::kIsometric);
  viewport.fit();
}

/// A moment on the top, a torque on a side, whose axis ends on the body, and the weight.
void momentsAndWeight(Viewport& viewport) {
  using Kind = ForceArrow::Kind;
  const Solid box = modeling::makeBox({60, 30, 20});
  show(box, viewport);
  viewport.setControlNetVisible(false);
  viewport.setMarks(marks(
      box, {{"side_xmin", Mark::kSupport}, {"side_xmax", Mark::kLoad}, {"top", Mark::kLoad}}));
  const auto applied = ForceArrow::Role::kApplied;
  viewport.setLoadArrows(
      {{{0, 0, 20}, {0, 0, 5}, ForceArrow::Anchor::kTail, applied, "5.00 N mm", Kind::kMoment},
       {{30, 0, 10}, {-2, 0, 0}, ForceArrow::Anchor::kTip, applied, "2.00 N mm", Kind::kMoment},
       {{0, 0, 10}, {0, 0, -0.4}, ForceArrow::Anchor::kTail, applied, "0.40 N", Kind::kWeight}});
  viewport.lookFrom(view::StandardView::kIsometric);
  viewport.fit();
}

void warnings(Viewport& viewport) {
  const Solid cylinder = modeling::makeCylinder(15, 40);
  show(cylinder, viewport);
  viewport.setMarks(marks(cylinder, {{"top", Mark::kWarning}}));
  viewport.setWarnings({{{0, 0, 40}, "Patch \"top\" folds over itself"},
                        {{15, 0, 20}, "Too thin here: 0.12 mm"},
                        {{14, -3, 19}, "Control points coincide"}});
}

void parallelTop(Viewport& viewport) {
  show(modeling::makeBox({40, 30, 20}), viewport);
  viewport.setParallelProjection(true);
  viewport.lookFrom(view::StandardView::kTop);
  viewport.fit();
}

void gridFromAfar(Viewport& viewport) {
  const Solid box = modeling::makeBox({40, 30, 20});
  show(box, viewport);
  viewport.setControlNetVisible(false);
  viewport.orbit({60, -30});
  viewport.zoom(0.25, {400, 300});
}

void closeUp(Viewport& viewport) {
  show(modeling::makeSphere(25), viewport);
  viewport.zoom(8, {400, 250});
}

void knotLines(Viewport& viewport) {
  show(modeling::makeSphere(25, 9), viewport);
  viewport.setControlNetVisible(false);
  viewport.setGridVisible(false);
}

void plainShaded(Viewport& viewport) {
  show(modeling::makeSphere(25), viewport);
  viewport.setShading(view::Shading::kShaded);
  viewport.setControlNetVisible(false);
  viewport.setAxesVisible(false);
}

/// The sphere with one point selected and a gizmo of the kind on it.
void gizmo(Viewport& viewport, view::GizmoKind kind, view::GizmoAxis highlighted) {
  const Solid sphere = modeling::makeSphere(25);
  show(sphere, viewport);
  viewport.setControlNetVisible(false);
  viewport.orbit({40, 40});
  viewport.setGizmo(
      view::Gizmo{{6, -10, 8}, Vector3d(0.5, -0.6, 0.62).normalized(), highlighted, kind});
}

/// Lines around and through a box in all styles, half of them over everything.
void toolDrawing(Viewport& viewport) {
  using Style = view::ToolDrawing::Style;
  show(modeling::makeBox({40, 30, 20}), viewport);
  viewport.setControlNetVisible(false);
  view::ToolDrawing drawing;
  const auto frame = [](double z, double size) {
    std::vector<Vector3d> points;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
      points.push_back({x * size * 24.0, y * size * 18.0, z});
    }
    return points;
  };
  drawing.lines = {{frame(4, 1), Style::kPreview, true},
                   {frame(9, 1), Style::kHovered, true},
                   {frame(14, 1), Style::kSelected, true},
                   {frame(18, 1), Style::kGuide, true},
                   {frame(24, 0.8), Style::kPreview, false},
                   {frame(28, 0.8), Style::kSelected, false},
                   // Through the eye: cut off in front of it.
                   {{{0, -2000, 10}, {0, 2000, 10}}, Style::kGuide, false},
                   {{{-12, 0, 5}, {12, 0, 15}}, Style::kHovered, false}};
  drawing.dots = {{{-12, 0, 5}, Style::kHovered},
                  {{12, 0, 15}, Style::kPreview},
                  {{20, -15, 20}, Style::kSelected},
                  {{-20, -15, 20}, Style::kGuide}};
  drawing.labels = {{{12, 0, 15}, "24.5 mm"}, {{-12, 0, 5}, "x −12.00  y 0.00  z 5.00 mm"}};
  viewport.setToolDrawing(drawing);
}

/// In front, selected, behind the body, without label, and pointing at the viewer.
void touches(Viewport& viewport) {
  show(modeling::makeSphere(25), viewport);
  viewport.setControlNetVisible(false);
  const auto on = [](double x, double y, double z) {
    return Vector3d(25 * Vector3d(x, y, z).normalized());
  };
  viewport.setTouchMarkers({{on(0.2, -1, 0.6), {0, 1, 0}, "Press", false},
                            {on(-0.7, -0.9, 0.1), {-3, -2, 0}, "Pull", true},
                            {on(1, -0.5, -0.3), {0, 0, -0.01}, "", false},
                            {on(-0.6, 1, 0.4), {0, 0, 2}, "Behind", false},
                            {on(0.5, -1, -0.5), {0, 0, 0}, "Held", false}});
}

/// Numbers below zero in a half space and within a ball, which cut through the triangles.
std::vector<double> field(const ViewportBody& body, const std::function<double(Vector3d)>& value) {
  std::vector<double> numbers;
  for (const Vector3d& position : body.positions) numbers.push_back(value(position));
  return numbers;
}

void regions(Viewport& viewport) {
  const Solid sphere = modeling::makeSphere(25);
  show(sphere, viewport);
  viewport.setControlNetVisible(false);
  const ViewportBody body = viewportBody(sphere);
  viewport.setRegions(
      field(body, [](const Vector3d& x) { return x.z() + 0.4 * x.x() + 9; }),
      field(body, [](const Vector3d& x) { return (x - Vector3d(8, -20, 12)).norm() - 9; }));
}

/// Where a load lies on a support, the support wins; a hovered patch shows both.
void overlappingRegions(Viewport& viewport) {
  const Solid box = modeling::makeBox({40, 30, 20});
  show(box, viewport);
  viewport.setControlNetVisible(false);
  const ViewportBody body = viewportBody(box);
  viewport.setMarks(marks(box, {{"side_ymin", Mark::kHovered}}));
  viewport.setRegions(
      field(body, [](const Vector3d& x) { return x.x() + 3; }),
      field(body, [](const Vector3d& x) { return (x - Vector3d(0, -10, 20)).norm() - 12; }));
}

/// Whole patches: the numbers jump at their borders.
void patchRegions(Viewport& viewport) {
  const Solid cylinder = modeling::makeCylinder(15, 40);
  show(cylinder, viewport);
  viewport.setControlNetVisible(false);
  const ViewportBody body = viewportBody(cylinder);
  std::vector<double> supports(body.positions.size(), 1e30);
  std::vector<double> loads = supports;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const auto patch = static_cast<std::size_t>(body.patchOfTriangle[t]);
    const std::string& name = cylinder.patches()[patch].name;
    for (const int corner : body.triangles[t]) {
      if (name == "top") loads[static_cast<std::size_t>(corner)] = -1e30;
      if (patch == 0) supports[static_cast<std::size_t>(corner)] = -1e30;
    }
  }
  viewport.setRegions(supports, loads);
  viewport.fit();
}

/// Flat triangles with faces as patches, as of an imported mesh.
void meshBody(Viewport& viewport) {
  ViewportBody flat;
  const ViewportBody round = viewportBody(modeling::makeSphere(25), 2);
  for (const view::Triangle& triangle : round.triangles) {
    std::array<Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = round.positions[static_cast<std::size_t>(triangle[k])];
    }
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    const int first = static_cast<int>(flat.positions.size());
    flat.positions.insert(flat.positions.end(), corners.begin(), corners.end());
    flat.normals.insert(flat.normals.end(), 3, normal);
    flat.triangles.push_back({first, first + 1, first + 2});
    flat.patchOfTriangle.push_back(0);
  }
  viewport.setBody(flat);
  viewport.setControlNet({});
  viewport.fit();
  viewport.setRegions(field(flat, [](const Vector3d& x) { return x.z() + 12; }), {});
}

void nothingShown(Viewport& viewport) {
  boundaryConditions(viewport);
  viewport.setMarks(std::vector<Mark>(
      viewportBody(modeling::makeBox({60, 30, 20})).triangles.size(), Mark::kNone));
  viewport.setWarnings({{{0, 0, 20}, "Not seen"}});
  viewport.setTouchMarkers({{{0, 0, 20}, {0, 0, 1}, "Not seen", true}});
  viewport.setRegionsVisible(false);
  viewport.setTouchesVisible(false);
  viewport.setWarningsVisible(false);
}

/// Beside a colour bar; the pointer is on an edge of the cube.
void viewCube(Viewport& viewport) {
  const Solid sphere = modeling::makeSphere(25);
  show(sphere, viewport);
  viewport.setControlNetVisible(false);
  viewport.setViewCubeVisible(true);
  viewport.setHoveredCubePart(view::ViewCubePart{{1, -1, 0}});
  view::ScalarField height{"Height", "mm"};
  for (const Vector3d& position : viewportBody(sphere).positions)
    height.values.push_back(position.z());
  height.range = {-25, 25};
  viewport.setField(height);
  viewport.lookFrom(view::StandardView::kIsometric);
  viewport.fit();
}

void viewCubeFromAbove(Viewport& viewport) {
  show(modeling::makeBox({40, 30, 20}), viewport);
  viewport.setControlNetVisible(false);
  viewport.setViewCubeVisible(true);
  viewport.setHoveredCubePart(
      view::ViewCubePart{Eigen::Vector3i::Zero(), view::ViewCubePart::Arrow::kLeft});
  viewport.orbit({40, 120});
  viewport.fit();
}

std::function<void(Viewport&)> dark(std::function<void(Viewport&)> light) {
  return [light = std::move(light)](Viewport& viewport) {
    light(viewport);
    viewport.setTheme(view::ViewportTheme::dark());
  };
}

void rotateGizmo(Viewport& viewport) {
  gizmo(viewport, view::GizmoKind::kRotate, view::GizmoAxis::kZ);
}

void scaleGizmo(Viewport& viewport) {
  gizmo(viewport, view::GizmoKind::kScale, view::GizmoAxis::kAll);
}

void wireRegions(Viewport& viewport) {
  regions(viewport);
  viewport.setShading(view::Shading::kWire);
}

}  // namespace

ViewportBody viewportBody(const Solid& solid, int piecesPerSpan) {
  const modeling::Tessellation tessellation(solid, piecesPerSpan);
  const auto shape = tessellation.evaluate(solid.controlPoints());
  return {shape.positions,          shape.normals,
          tessellation.triangles(), tessellation.patchOfTriangle(),
          tessellation.borders(),   tessellation.knotLines()};
}

ControlNet controlNet(const Solid& solid) {
  return {solid.controlPoints(), modeling::controlNetLines(solid)};
}

std::map<std::string, ViewportCase> viewportCases() {
  return {
      {"viewport_shaded", {plainShaded}},
      {"viewport_selection_gizmo", {selection}},
      {"viewport_rubber_band", {rubberBand}},
      {"viewport_dark_boundary_conditions", {dark(boundaryConditions)}},
      {"viewport_moments_and_weight", {momentsAndWeight}},
      {"viewport_view_cube", {viewCube}},
      {"viewport_dark_view_cube", {dark(viewCubeFromAbove)}},
      {"viewport_warnings", {warnings}},
      {"viewport_parallel_top", {parallelTop}},
      {"viewport_grid_from_afar", {gridFromAfar}},
      {"viewport_close_up", {closeUp}},
      {"viewport_knot_lines", {knotLines}},
      {"viewport_high_dpi", {selection, 1200, 900, 2}},
      {"viewport_dark_gizmo_rotate", {dark(rotateGizmo)}},
      {"viewport_gizmo_scale", {scaleGizmo}},
      {"viewport_tool_drawing", {toolDrawing}},
      {"viewport_dark_touches", {dark(touches)}},
      {"viewport_regions_overlapping", {overlappingRegions}},
      {"viewport_regions_of_patches", {patchRegions}},
      {"viewport_regions_wire", {wireRegions}},
      {"viewport_mesh_body", {meshBody}},
      {"viewport_nothing_shown", {nothingShown}},
      {"viewport_empty", {[](Viewport& v) { v.fit(); }, 320, 240}},
  };
}

void draw(const ViewportCase& viewportCase, const std::filesystem::path& picture) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(viewportCase.width, viewportCase.height);
  Viewport viewport(window, viewportCase.pixelRatio);
  viewportCase.setUp(viewport);
  viewport.writePng(picture);
}

void drawAfter(const ViewportCase& first, const ViewportCase& last,
               const std::filesystem::path& picture) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(first.width / 2, first.height / 2);
  Viewport viewport(window, first.pixelRatio);
  first.setUp(viewport);
  viewport.render(view::Quality::kQuick);
  window->SetSize(last.width, last.height);
  viewport.setPixelRatio(last.pixelRatio);
  last.setUp(viewport);
  viewport.writePng(picture);
}

}  // namespace palpa::render_tests

#include "tests/render/viewport_scenes.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>

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

void hoveredPoint(Viewport& viewport) {
  const Solid cylinder = modeling::makeCylinder(15, 40);
  show(cylinder, viewport);
  const std::size_t point = nearest(cylinder, {15, 0, 40});
  std::vector<HandleState> states(cylinder.controlPoints().size(), HandleState::kPlain);
  states[point] = HandleState::kHovered;
  viewport.setHandleStates(states);
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

void warnings(Viewport& viewport) {
  const Solid cylinder = modeling::makeCylinder(15, 40);
  show(cylinder, viewport);
  viewport.setMarks(marks(cylinder, {{"top", Mark::kWarning}}));
  viewport.setWarnings({{{0, 0, 40}, "Patch \"top\" folds over itself"},
                        {{15, 0, 20}, "Too thin here: 0.12 mm"},
                        {{14, -3, 19}, "Control points coincide"}});
}

void darkSelection(Viewport& viewport) {
  selection(viewport);
  viewport.setTheme(view::ViewportTheme::dark());
}

void darkBoundaryConditions(Viewport& viewport) {
  boundaryConditions(viewport);
  viewport.setTheme(view::ViewportTheme::dark());
}

void wire(Viewport& viewport) {
  const Solid cylinder = modeling::makeCylinder(15, 40);
  show(cylinder, viewport);
  viewport.setMarks(marks(cylinder, {{"bottom", Mark::kSupport}}));
  viewport.setControlNetVisible(false);
  viewport.setShading(view::Shading::kWire);
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

void fromBelow(Viewport& viewport) {
  show(modeling::makeCylinder(15, 40), viewport);
  viewport.orbit({0, -100});
  viewport.fit();
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
      {"viewport_sphere_net", {[](Viewport& v) { show(modeling::makeSphere(25), v); }}},
      {"viewport_cylinder_edges", {[](Viewport& v) {
         show(modeling::makeCylinder(15, 40), v);
         v.setControlNetVisible(false);
       }}},
      {"viewport_shaded", {plainShaded}},
      {"viewport_wire", {wire}},
      {"viewport_selection_gizmo", {selection}},
      {"viewport_hovered_point", {hoveredPoint}},
      {"viewport_rubber_band", {rubberBand}},
      {"viewport_boundary_conditions", {boundaryConditions}},
      {"viewport_warnings", {warnings}},
      {"viewport_dark_selection", {darkSelection}},
      {"viewport_dark_boundary_conditions", {darkBoundaryConditions}},
      {"viewport_parallel_top", {parallelTop}},
      {"viewport_grid_from_afar", {gridFromAfar}},
      {"viewport_close_up", {closeUp}},
      {"viewport_from_below", {fromBelow}},
      {"viewport_knot_lines", {knotLines}},
      {"viewport_high_dpi", {selection, 1200, 900, 2}},
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

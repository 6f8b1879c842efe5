#include "app/gui/view/scene_controller.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "app/gui/document/named_items.h"
#include "app/gui/document/point_groups.h"
#include "app/gui/document/touch_gradient.h"
#include "app/gui/view/condition_marks.h"

namespace palpa::gui {
namespace {

using view::HandleState;
using view::Mark;

/// Union of two fields, as their minimum; either may be empty.
void unite(std::vector<double>& field, const std::vector<double>& other) {
  if (field.empty()) {
    field = other;
    return;
  }
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::min(field[i], other[i]);
}

}  // namespace

SceneController::SceneController(Editor& editor, const Settings& settings, ViewportWidget& widget)
    : QObject(&widget),
      editor_(editor),
      settings_(settings),
      widget_(widget),
      dimensions_(new DimensionView(editor, settings, widget)) {
  connect(&editor, &Editor::projectReplaced, this, [this] {
    showProject();
    if (extent_ != Extent::kNothing) widget_.viewport().fit();
  });
  connect(&editor, &Editor::projectChanged, this, &SceneController::showChange);
  connect(&editor, &Editor::selectionChanged, this, &SceneController::showSelection);
  connect(&editor, &Editor::selectionChanged, this, &SceneController::showTouches);
  connect(&settings, &Settings::changed, this, [this] {
    if (extent_ != Extent::kNothing) showLoads();  // labels contain units
  });
  connect(&editor, &Editor::rebuildChanged, this, &SceneController::showConflict);
  connect(&editor.gradient(), &TouchGradient::changed, this, &SceneController::showSelection);
  showProject();
  widget_.viewport().fit();
}

void SceneController::show(Extent extent) {
  if (extent == extent_) return;
  extent_ = extent;
  view::Viewport& viewport = widget_.viewport();
  if (extent != Extent::kAll) {
    viewport.setControlNet({});
    netSize_ = 0;
    viewport.setGizmo(std::nullopt);
    viewport.setTouchMarkers({});
    viewport.setToolDrawing({});
  }
  if (extent != Extent::kNothing) {
    showProject();
    return;
  }
  viewport.setLoadArrows({});
  viewport.setRegions({}, {});
}

void SceneController::showProject() {
  // Also if nothing is drawn: surface() belongs to the present body.
  const modeling::Solid* solid = editor_.solid();
  tessellation_ = solid ? std::make_unique<modeling::Tessellation>(*solid) : nullptr;
  if (solid) shape_ = tessellation_->evaluate(solid->controlPoints());
  if (extent_ == Extent::kNothing) return;
  hovered_.reset();
  hoveredPatch_.reset();
  following_.clear();
  if (!solid) {
    showMeshBody();
    return;
  }
  widget_.viewport().setBody({shape_.positions, shape_.normals, tessellation_->triangles(),
                              tessellation_->patchOfTriangle(), tessellation_->borders(),
                              tessellation_->knotLines()});
  setPatches(tessellation_->triangles(), tessellation_->patchOfTriangle());
  if (extent_ == Extent::kAll) {
    widget_.viewport().setControlNet({solid->controlPoints(), modeling::controlNetLines(*solid)});
    netSize_ = solid->controlPoints().size();
  }
  showRegions();
  showMarks();
  showSelection();
  showLoads();
  showTouches();
}

void SceneController::showMeshBody() {
  const auto& body = std::get<modeling::MeshBody>(editor_.project().body);
  view::ViewportBody shown;
  for (std::size_t t = 0; t < body.triangles().size(); ++t) {
    const auto& [a, b, c] = body.triangles()[t];
    const auto& p = body.positions();
    const Eigen::Vector3d normal = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    const int first = static_cast<int>(shown.positions.size());
    shown.positions.insert(shown.positions.end(), {p[a], p[b], p[c]});
    shown.normals.insert(shown.normals.end(), 3, normal);
    shown.triangles.push_back({first, first + 1, first + 2});
    shown.patchOfTriangle.push_back(body.faceOfTriangle()[t]);
  }
  widget_.viewport().setBody(shown);
  setPatches(shown.triangles, shown.patchOfTriangle);
  shape_ = {shown.positions, shown.normals};
  widget_.viewport().setControlNet({});
  netSize_ = 0;
  widget_.viewport().setGizmo(std::nullopt);
  showRegions();
  showMarks();
  showLoads();
  showTouches();
}

void SceneController::setPatches(const std::vector<view::Triangle>& triangles,
                                 const std::vector<int>& patchOfTriangle) {
  patchOfTriangle_ = patchOfTriangle;
  patchOfPosition_.clear();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const int corner : triangles[t]) {
      if (static_cast<std::size_t>(corner) >= patchOfPosition_.size())
        patchOfPosition_.resize(static_cast<std::size_t>(corner) + 1, 0);
      patchOfPosition_[static_cast<std::size_t>(corner)] = patchOfTriangle[t];
    }
  }
}

void SceneController::showChange(const modeling::Change& change) {
  if (change.topology) {
    showProject();
    return;
  }
  if (!change.movedPoints.empty() && tessellation_)
    shape_ = tessellation_->evaluate(editor_.solid()->controlPoints());
  if (extent_ == Extent::kNothing) return;
  if (!change.movedPoints.empty() && tessellation_) {
    const auto& points = editor_.solid()->controlPoints();
    widget_.viewport().moveBody(shape_.positions, shape_.normals);
    if (extent_ == Extent::kAll) widget_.viewport().moveControlPoints(points);
    showSelection();
    widget_.updateQuickly();
  }
  const bool isMoved = !change.movedPoints.empty();
  if (change.supports || change.loads || isMoved) showRegions();
  if (change.loads || isMoved) showLoads();
  if (change.touches) showTouches();
}

void SceneController::showRegions() {
  const modeling::Project& project = editor_.project();
  const auto fieldOf = [&](const modeling::Region& region) {
    return modeling::regionField(region, project.body, shape_.positions, patchOfPosition_);
  };
  std::vector<double> supports, loads;
  for (const modeling::Support& support : project.supports) unite(supports, fieldOf(support.where));
  for (const modeling::Load& load : project.loads)
    if (const modeling::Region* region = modeling::regionOf(load)) unite(loads, fieldOf(*region));
  std::vector<double> overlap;
  if (conflict_ && conflict_->overlaps) {
    const auto* first = findNamed(project.supports, conflict_->first);
    const auto* second = findNamed(project.supports, conflict_->second);
    if (first && second) {
      overlap = fieldOf(first->where);
      const std::vector<double> other = fieldOf(second->where);
      for (std::size_t i = 0; i < overlap.size(); ++i) overlap[i] = std::max(overlap[i], other[i]);
    }
  }
  widget_.viewport().setRegions(supports, loads, overlap);
}

void SceneController::showConflict() {
  const auto conflict = editor_.rebuildStatus().reason.conflict;
  if (conflict == conflict_) return;
  conflict_ = conflict;
  if (extent_ == Extent::kNothing) return;
  showRegions();
  widget_.update();
}

void SceneController::showMarks() {
  if (extent_ == Extent::kNothing) return;
  const std::set<int>& selected = editor_.selection().patches;
  std::vector<Mark> marks(patchOfTriangle_.size(), Mark::kNone);
  for (std::size_t t = 0; t < marks.size(); ++t) {
    if (selected.contains(patchOfTriangle_[t])) marks[t] = Mark::kSelected;
    if (patchOfTriangle_[t] == hoveredPatch_) marks[t] = Mark::kHovered;
  }
  widget_.viewport().setMarks(marks);
}

void SceneController::showLoads() {
  widget_.viewport().setLoadArrows(loadArrows(editor_.project(), surface(), settings_.units()));
  widget_.update();
}

void SceneController::showTouches() {
  if (extent_ != Extent::kAll) return;
  widget_.viewport().setTouchMarkers(touchMarkers(editor_.project(), editor_.selection()));
  widget_.update();
}

void SceneController::showSelection() {
  const modeling::Solid* solid = editor_.solid();
  // selectionChanged may arrive while the view still has the previous net.
  if (extent_ != Extent::kAll || !solid || solid->controlPoints().size() != netSize_) return;
  const std::set<int> moved = pointsOf(editor_.selection(), *solid);
  std::vector<HandleState> states(solid->controlPoints().size(), HandleState::kPlain);
  for (int point : moved) states[point] = HandleState::kFollowing;
  for (int point : following_) states[point] = HandleState::kFollowing;
  if (hovered_) states[*hovered_] = HandleState::kHovered;
  for (int point : editor_.selection().points) states[point] = HandleState::kSelected;
  widget_.viewport().setHandleStates(states);
  std::optional<view::Gizmo> gizmo;
  if (gizmoKind_ && !moved.empty()) {
    gizmo = view::Gizmo{meanOf(moved, *solid), std::nullopt, axis_, *gizmoKind_};
    const Eigen::Vector3d normal = meanNormal(moved, *solid);
    if (*gizmoKind_ != view::GizmoKind::kScale && !normal.isZero()) gizmo->normal = normal;
    if (*gizmoKind_ == view::GizmoKind::kMove)
      gizmo->gradient = editor_.gradient().directionOf(moved);
  }
  widget_.viewport().setGizmo(gizmo);
  if (markedPatches_ != editor_.selection().patches) {
    markedPatches_ = editor_.selection().patches;
    showMarks();
  }
  widget_.update();
}

void SceneController::setGizmoKind(std::optional<view::GizmoKind> kind) {
  gizmoKind_ = kind;
  showSelection();
}

void SceneController::setFollowing(std::set<int> points) {
  if (points == following_) return;
  following_ = std::move(points);
  showSelection();
}

void SceneController::setHoveredPatch(std::optional<int> patch) {
  if (patch == hoveredPatch_) return;
  hoveredPatch_ = patch;
  showMarks();
  widget_.update();
}

void SceneController::setHovered(std::optional<int> point) {
  if (point == hovered_) return;
  hovered_ = point;
  showSelection();
}

void SceneController::setGizmoAxis(view::GizmoAxis axis) {
  if (axis == axis_) return;
  axis_ = axis;
  showSelection();
}

}  // namespace palpa::gui

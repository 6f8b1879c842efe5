#include "app/gui/scene_controller.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "app/gui/condition_marks.h"
#include "modeling/solid/isoparametric_line.h"

namespace palpa::gui {
namespace {

using view::HandleState;
using view::Mark;

/// A region with its patches looked up once, for many triangles.
class RegionTest {
 public:
  RegionTest(const modeling::Region& region, const modeling::Body& body)
      : isNamed_(modeling::patchNames(body).size(), false) {
    for (const modeling::RegionPart& part : region.parts) {
      if (const auto* half = std::get_if<modeling::HalfSpace>(&part)) halfSpaces_.push_back(*half);
      if (const auto* stroke = std::get_if<modeling::Stroke>(&part)) strokes_.push_back(*stroke);
      if (const auto* set = std::get_if<modeling::PatchSet>(&part))
        for (const std::string& name : set->patches)
          if (const auto patch = modeling::findPatch(body, name)) isNamed_[*patch] = true;
    }
  }

  bool contains(int patch, const Eigen::Vector3d& point) const {
    const auto isInside = [&](const auto& part) { return part.value(point) < 0.0; };
    return isNamed_[patch] || std::any_of(halfSpaces_.begin(), halfSpaces_.end(), isInside) ||
           std::any_of(strokes_.begin(), strokes_.end(), isInside);
  }

 private:
  std::vector<bool> isNamed_;
  std::vector<modeling::HalfSpace> halfSpaces_;
  std::vector<modeling::Stroke> strokes_;
};

}  // namespace

SceneController::SceneController(Editor& editor, ViewportWidget& widget)
    : QObject(&widget), editor_(editor), widget_(widget) {
  connect(&editor, &Editor::projectReplaced, this, [this] {
    showProject();
    widget_.viewport().fit();
  });
  connect(&editor, &Editor::projectChanged, this, &SceneController::showChange);
  connect(&editor, &Editor::selectionChanged, this, &SceneController::showSelection);
  connect(&editor, &Editor::selectionChanged, this, &SceneController::showConditions);
  showProject();
  widget_.viewport().fit();
}

void SceneController::showProject() {
  hovered_.reset();
  hoveredPatch_.reset();
  const modeling::Solid* solid = editor_.solid();
  if (!solid) {
    showMeshBody();
    return;
  }
  tessellation_ = std::make_unique<modeling::Tessellation>(*solid);
  shape_ = tessellation_->evaluate(solid->controlPoints());
  widget_.viewport().setBody({shape_.positions, shape_.normals, tessellation_->triangles(),
                              tessellation_->patchOfTriangle(), tessellation_->borders(),
                              tessellation_->knotLines()});
  widget_.viewport().setControlNet({solid->controlPoints(), modeling::controlNetLines(*solid)});
  showMarks();
  showSelection();
  showConditions();
}

void SceneController::showMeshBody() {
  tessellation_.reset();
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
  widget_.viewport().setControlNet({});
  widget_.viewport().setGizmo(std::nullopt);
  showMarks();
  showConditions();
}

void SceneController::showChange(const modeling::Change& change) {
  if (change.topology) {
    showProject();
    return;
  }
  if (!change.movedPoints.empty() && tessellation_) {
    const auto& points = editor_.solid()->controlPoints();
    shape_ = tessellation_->evaluate(points);
    widget_.viewport().moveBody(shape_.positions, shape_.normals);
    widget_.viewport().moveControlPoints(points);
    showSelection();
    widget_.updateQuickly();
  }
  if (change.supports || change.loads || !change.movedPoints.empty()) showMarks();
  showConditions();
}

void SceneController::showMarks() {
  const modeling::Project& project = editor_.project();
  const ShownSurface shown = surface();
  std::vector<std::pair<RegionTest, Mark>> regions;  // what wins comes last
  for (const modeling::Load& load : project.loads)
    if (const modeling::Region* region = modeling::regionOf(load))
      regions.emplace_back(RegionTest(*region, project.body), Mark::kLoad);
  for (const modeling::Support& support : project.supports)
    regions.emplace_back(RegionTest(support.where, project.body), Mark::kSupport);
  std::vector<Mark> marks(shown.triangles.size(), Mark::kNone);
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const int patch = shown.patchOfTriangle[t];
    const Eigen::Vector3d middle = shown.middle(t);
    for (const auto& [region, mark] : regions)
      if (region.contains(patch, middle)) marks[t] = mark;
    if (patch == hoveredPatch_) marks[t] = Mark::kHovered;
  }
  widget_.viewport().setMarks(marks);
}

void SceneController::showConditions() {
  widget_.viewport().setLoadArrows(loadArrows(editor_.project(), surface()));
  widget_.viewport().setTouchMarkers(touchMarkers(editor_.project(), editor_.selection()));
  widget_.update();
}

ShownSurface SceneController::surface() const {
  if (tessellation_)
    return {shape_.positions, tessellation_->triangles(), tessellation_->patchOfTriangle()};
  const auto& body = std::get<modeling::MeshBody>(editor_.project().body);
  return {body.positions(), body.triangles(), body.faceOfTriangle()};
}

std::optional<SurfacePlace> SceneController::placeAt(const Eigen::Vector2d& pixel) const {
  const auto hit = widget_.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  const ShownSurface shown = surface();
  const auto& [a, b, c] = shown.triangles[hit->triangle];
  const Eigen::Vector3d& from = shown.positions[a];
  const Eigen::Vector3d p = shown.positions[b] - from;
  const Eigen::Vector3d q = shown.positions[c] - from;
  const Eigen::Vector3d area = p.cross(q);
  SurfacePlace place{shown.patchOfTriangle[hit->triangle], std::nullopt, hit->position,
                     area.normalized()};
  if (!tessellation_) return place;
  const Eigen::Vector3d r = hit->position - from;
  const double s = r.cross(q).dot(area) / area.squaredNorm();
  const double t = p.cross(r).dot(area) / area.squaredNorm();
  const auto& parameters = tessellation_->parameters();
  const Eigen::Vector2d uv = (1.0 - s - t) * parameters[a] + s * parameters[b] + t * parameters[c];
  const Eigen::Vector3d normal =
      (1.0 - s - t) * shape_.normals[a] + s * shape_.normals[b] + t * shape_.normals[c];
  if (normal.norm() > 0.0) place.normal = normal.normalized();
  place.parameters = uv;
  // On the exact surface, which the triangles only come near to.
  place.position = modeling::surfacePoint(*editor_.solid(), place.patch, uv.x(), uv.y());
  return place;
}

void SceneController::setHoveredPatch(std::optional<int> patch) {
  if (patch == hoveredPatch_) return;
  hoveredPatch_ = patch;
  showMarks();
  widget_.update();
}

std::optional<Eigen::Vector3d> SceneController::selectionCentre() const {
  const modeling::Solid* solid = editor_.solid();
  const std::set<int>& points = editor_.selection().points;
  if (!solid || points.empty()) return std::nullopt;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int point : points) sum += solid->controlPoints()[point];
  return sum / static_cast<double>(points.size());
}

void SceneController::showSelection() {
  const modeling::Solid* solid = editor_.solid();
  if (!solid) return;
  std::vector<HandleState> states(solid->controlPoints().size(), HandleState::kPlain);
  if (hovered_) states[*hovered_] = HandleState::kHovered;
  for (int point : editor_.selection().points) states[point] = HandleState::kSelected;
  widget_.viewport().setHandleStates(states);
  const auto centre = selectionCentre();
  widget_.viewport().setGizmo(centre ? std::optional(view::Gizmo{*centre, std::nullopt, axis_})
                                     : std::nullopt);
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

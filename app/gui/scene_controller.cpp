#include "app/gui/scene_controller.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "app/gui/point_groups.h"

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
      if (const auto* half = std::get_if<modeling::HalfSpace>(&part)) {
        halfSpaces_.push_back(*half);
        continue;
      }
      for (const std::string& name : std::get<modeling::PatchSet>(part).patches)
        if (const auto patch = modeling::findPatch(body, name)) isNamed_[*patch] = true;
    }
  }

  bool contains(int patch, const Eigen::Vector3d& point) const {
    return isNamed_[patch] ||
           std::any_of(halfSpaces_.begin(), halfSpaces_.end(),
                       [&](const modeling::HalfSpace& half) { return half.value(point) < 0.0; });
  }

 private:
  std::vector<bool> isNamed_;
  std::vector<modeling::HalfSpace> halfSpaces_;
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
  showProject();
  widget_.viewport().fit();
}

void SceneController::showProject() {
  hovered_.reset();
  hoveredPatch_.reset();
  following_.clear();
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
  netSize_ = solid->controlPoints().size();
  showMarks();
  showSelection();
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
  netSize_ = 0;
  widget_.viewport().setGizmo(std::nullopt);
  widget_.update();
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
  widget_.update();
}

void SceneController::showMarks() {
  if (!tessellation_) return;
  const modeling::Project& project = editor_.project();
  std::vector<std::pair<RegionTest, Mark>> regions;  // what wins comes last
  for (const modeling::Load& load : project.loads)
    if (const modeling::Region* region = modeling::regionOf(load))
      regions.emplace_back(RegionTest(*region, project.body), Mark::kLoad);
  for (const modeling::Support& support : project.supports)
    regions.emplace_back(RegionTest(support.where, project.body), Mark::kSupport);
  std::vector<Mark> marks(tessellation_->triangles().size(), Mark::kNone);
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const auto& [a, b, c] = tessellation_->triangles()[t];
    const Eigen::Vector3d middle =
        (shape_.positions[a] + shape_.positions[b] + shape_.positions[c]) / 3.0;
    for (const auto& [region, mark] : regions)
      if (region.contains(tessellation_->patchOfTriangle()[t], middle)) marks[t] = mark;
  }
  markPatches(marks);
  widget_.viewport().setMarks(marks);
}

void SceneController::markPatches(std::vector<Mark>& marks) const {
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const int patch = tessellation_->patchOfTriangle()[t];
    if (editor_.selection().patches.contains(patch)) marks[t] = Mark::kSelected;
    if (patch == hoveredPatch_) marks[t] = Mark::kHovered;
  }
}

std::optional<int> SceneController::patchAt(const Eigen::Vector2d& pixel) const {
  const auto hit = widget_.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  if (tessellation_) return tessellation_->patchOfTriangle()[hit->triangle];
  return std::get<modeling::MeshBody>(editor_.project().body).faceOfTriangle()[hit->triangle];
}

std::optional<int> SceneController::edgeAt(const Eigen::Vector2d& pixel) const {
  const auto border = widget_.viewport().borderAt(pixel);
  if (!border || !editor_.solid()) return std::nullopt;
  // Tessellation::borders() has the four sides of each patch, in the order of kSides.
  return editor_.solid()->edgeOf(*border / 4, modeling::kSides[*border % 4]);
}

std::vector<Eigen::Vector3d> SceneController::edgeLine(int edge) const {
  std::vector<Eigen::Vector3d> line;
  const modeling::Solid* solid = editor_.solid();
  if (!solid || solid->controlPoints().size() != netSize_ ||
      edge >= static_cast<int>(solid->edges().size()))
    return line;
  const modeling::PatchEdge& use = solid->edges()[edge].uses[0];
  const int border = 4 * use.patch + static_cast<int>(use.side);
  for (int vertex : tessellation_->borders()[border]) line.push_back(shape_.positions[vertex]);
  return line;
}

std::optional<Eigen::Vector3d> SceneController::selectionCentre() const {
  if (!editor_.solid()) return std::nullopt;
  const std::set<int> points = pointsOf(editor_.selection(), *editor_.solid());
  if (points.empty()) return std::nullopt;
  return meanOf(points, *editor_.solid());
}

void SceneController::showSelection() {
  const modeling::Solid* solid = editor_.solid();
  // With another topology the selection changes first; the view follows with the body.
  if (!solid || solid->controlPoints().size() != netSize_) return;
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

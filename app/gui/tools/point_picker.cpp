#include "app/gui/tools/point_picker.h"

#include <algorithm>

#include "app/gui/document/point_groups.h"

namespace palpa::gui {

using Pick = PointOptions::Pick;

PointPicker::PointPicker(Editor& editor, SceneController& scene, ViewportWidget& widget,
                         PointOptions& options)
    : editor_(editor), scene_(scene), widget_(widget), options_(options) {}

Pick PointPicker::pick() const {
  return editor_.solid() ? options_.pick() : Pick::kPatches;
}

std::optional<int> PointPicker::at(const Eigen::Vector2d& pixel) const {
  switch (pick()) {
    case Pick::kPoints:
      return widget_.viewport().controlPointAt(pixel);
    case Pick::kPatches:
      return scene_.patchAt(pixel);
    case Pick::kEdges:
      break;
  }
  return scene_.edgeAt(pixel);
}

std::set<int>& PointPicker::partOf(Selection& selection, Pick pick) {
  return pick == Pick::kPoints    ? selection.points
         : pick == Pick::kPatches ? selection.patches
                                  : selection.edges;
}

void PointPicker::hover(const Eigen::Vector2d& pixel) {
  const auto found = at(pixel);
  scene_.setHovered(pick() == Pick::kPoints ? found : std::nullopt);
  scene_.setHoveredPatch(pick() == Pick::kPatches ? found : std::nullopt);
  hoveredEdge_ = pick() == Pick::kEdges ? found : std::nullopt;
}

void PointPicker::unhover() {
  scene_.setHovered(std::nullopt);
  scene_.setHoveredPatch(std::nullopt);
  hoveredEdge_.reset();
}

std::optional<Selection> PointPicker::clicked(const Eigen::Vector2d& pixel, bool toggle) const {
  const auto found = at(pixel);
  if (!found) return std::nullopt;
  Selection present = editor_.selection();
  std::set<int> chosen = partOf(present, pick());
  if (toggle) {
    if (!chosen.erase(*found)) chosen.insert(*found);
  } else {
    chosen = {*found};
  }
  Selection selection;
  partOf(selection, pick()) = std::move(chosen);
  return selection;
}

bool PointPicker::isSelectedAt(const Eigen::Vector2d& pixel) const {
  const auto found = at(pixel);
  Selection present = editor_.selection();
  return found && partOf(present, pick()).contains(*found);
}

std::optional<Eigen::Vector3d> PointPicker::pointPlaceAt(const Eigen::Vector2d& pixel) const {
  if (pick() != Pick::kPoints) return std::nullopt;
  const auto point = at(pixel);
  if (!point) return std::nullopt;
  return editor_.solid()->controlPoints()[*point];
}

void PointPicker::stretchBox(const Eigen::Vector2d& pixel) {
  widget_.viewport().setRubberBand(std::array{*boxFrom_, pixel});
  widget_.update();
}

std::set<int> PointPicker::inBox(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
  const modeling::Solid* solid = editor_.solid();
  std::set<int> inside;
  if (!solid) return inside;
  if (pick() == Pick::kPoints) {
    const std::vector<int> points = widget_.viewport().controlPointsIn(a, b);
    return {points.begin(), points.end()};
  }
  const Eigen::Array2d low = a.cwiseMin(b);
  const Eigen::Array2d high = a.cwiseMax(b);
  const auto isInside = [&](int point) {
    const Eigen::Array2d pixel = widget_.viewport().toPixel(solid->controlPoints()[point]);
    return (pixel >= low).all() && (pixel <= high).all();
  };
  const bool patches = pick() == Pick::kPatches;
  const std::size_t count = patches ? solid->patches().size() : solid->edges().size();
  for (int i = 0; i < static_cast<int>(count); ++i) {
    const std::set<int> points = patches ? pointsOfPatch(*solid, i) : pointsOfEdge(*solid, i);
    if (std::all_of(points.begin(), points.end(), isInside)) inside.insert(i);
  }
  return inside;
}

void PointPicker::endBox(const PointerEvent& event) {
  const Eigen::Vector2d from = *boxFrom_;
  cancelBox();
  const bool add = (event.modifiers & Qt::ShiftModifier) != 0;
  const bool remove = (event.modifiers & Qt::ControlModifier) != 0;
  if ((event.pixel - from).norm() < kDragThreshold) {
    editor_.select(
        clicked(from, add || remove).value_or(add || remove ? editor_.selection() : Selection{}));
    return;
  }
  Selection selection;
  std::set<int>& chosen = partOf(selection, pick());
  Selection present = editor_.selection();
  if (add || remove) chosen = partOf(present, pick());
  for (int each : inBox(from, event.pixel)) {
    if (remove)
      chosen.erase(each);
    else
      chosen.insert(each);
  }
  editor_.select(std::move(selection));
}

void PointPicker::cancelBox() {
  boxFrom_.reset();
  widget_.viewport().setRubberBand(std::nullopt);
  widget_.update();
}

bool PointPicker::selectPointsOfPatchAt(const Eigen::Vector2d& pixel, bool add) {
  const auto patch = scene_.patchAt(pixel);
  if (!patch || !editor_.solid()) return false;
  std::set<int> points = pointsOfPatch(*editor_.solid(), *patch);
  if (add) points.merge(std::set<int>(editor_.selection().points));
  editor_.select(Selection::ofPoints(std::move(points)));
  return true;
}

}  // namespace palpa::gui

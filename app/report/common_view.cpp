#include "app/report/common_view.h"

#include <algorithm>

#include "app/view/scene/arrows.h"

namespace palpa::report {
namespace {

using Eigen::Vector3d;

double diagonalOf(const view::ViewportBody& body) {
  Vector3d low = body.positions.front(), high = low;
  for (const Vector3d& point : body.positions) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

}  // namespace

void CommonView::add(const view::Picture& picture) {
  if (picture.field) {
    const auto [low, high] =
        std::minmax_element(picture.field->values.begin(), picture.field->values.end());
    range_[0] = std::min(range_[0], picture.field->range ? (*picture.field->range)[0] : *low);
    range_[1] = std::max(range_[1], *high);
  }
  for (const Vector3d& point : picture.positions) reach(point);
  if (picture.hasGhost)
    for (const Vector3d& point : picture.body.positions) reach(point);
  for (const view::Ball& ball : picture.balls)
    for (const Vector3d& direction : directions()) reach(ball.center + ball.radius * direction);
  double force = 0;
  for (const view::ForceArrow& arrow : picture.arrows.arrows) {
    arrows_.arrows.push_back(arrow);
    if (arrow.kind != view::ForceArrow::Kind::kMoment) force = std::max(force, arrow.force.norm());
  }
  if (force >= fullForce_) {
    fullForce_ = force;
    camera_ = picture.camera;
  }
  if (fullLength_ == 0) fullLength_ = view::kFullArrowLength * diagonalOf(picture.body);
}

void CommonView::finish() {
  if (fullForce_ > 0) arrows_.fullForce = fullForce_;
  for (const view::PlacedArrow& placed : view::placeArrows(arrows_, fullLength_))
    reach(placed.freeEnd());
}

void CommonView::applyTo(view::Picture& picture) const {
  if (picture.field && range_[0] <= range_[1]) picture.field->range = range_;
  picture.arrows.fullForce = arrows_.fullForce;
  picture.arrows.minShare = 0;
  picture.camera = camera_;
  picture.room.assign(extremes_.begin(), extremes_.end());
}

/// Towards the faces, edges and corners of a cube.
const std::array<Vector3d, CommonView::kDirections>& CommonView::directions() {
  static const auto all = [] {
    std::array<Vector3d, kDirections> result;
    int count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0) result[count++] = Vector3d(x, y, z).normalized();
    return result;
  }();
  return all;
}

void CommonView::reach(const Vector3d& point) {
  if (!isAny_) extremes_.fill(point);
  isAny_ = true;
  for (int k = 0; k < kDirections; ++k)
    if (directions()[k].dot(point) > directions()[k].dot(extremes_[k])) extremes_[k] = point;
}

}  // namespace palpa::report

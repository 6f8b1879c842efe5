#include "app/core/design/search_state.h"

#include <algorithm>

#include "app/core/design/target_values.h"
#include "modeling/editing/nearest_on_patches.h"
#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Motions of a touch below this part of a millimetre are rounding.
constexpr double kUnmoved = 1e-9;

}  // namespace

ShapeEvaluator::ShapeEvaluator(const modeling::Project& project, const modeling::Design& design,
                               const DesignSpace& space, const BuildOptions& options)
    : project_(project), design_(design), space_(space), options_(options) {
  const modeling::Solid& solid = space.solid();
  std::vector<char> moves(solid.controlPoints().size(), 0);
  for (int point : space.points()) moves[static_cast<std::size_t>(point)] = 1;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    bool isMoving = false;
    for (const auto& row : solid.patches()[p].net)
      for (int index : row) isMoving = isMoving || moves[static_cast<std::size_t>(index)];
    if (isMoving) movingPatches_.push_back(static_cast<int>(p));
  }
}

double ShapeEvaluator::leastThickness(const WallThickness& wall) const {
  for (const WallThickness& first : firstWalls_)
    if (first.patch == wall.patch && first.place == wall.place)
      return std::min(first.value, *design_.smallestThickness);
  return 0;
}

void ShapeEvaluator::learnThicknesses(const SearchState& start) {
  firstWalls_ = start.walls;
}

void ShapeEvaluator::move(const DesignSpace::Moved& moved, SearchState& state) const {
  const std::vector<Vector3d>& from = space_.solid().controlPoints();
  state.project = project_;
  if (moved.points == from) return;
  // All points are named, so that the command keeps each at its place.
  std::vector<int> all(from.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  state.commands.push_back(modeling::MovePoints{
      modeling::PointSelection::of(std::move(all)), modeling::MoveTo{moved.points}, {}});
  modeling::NearestOnPatches nearest(space_.solid());
  for (const modeling::Touch& touch : project_.touches) {
    Vector3d shift = Vector3d::Zero();
    for (const auto& [point, weight] : nearest.of(touch.at)) {
      const auto index = static_cast<std::size_t>(point);
      shift += weight * (moved.points[index] - from[index]);
    }
    if (shift.norm() < kUnmoved) continue;
    modeling::Touch carried = touch;
    carried.at += shift;
    state.commands.push_back(modeling::SetTouch{touch.name, carried});
  }
  for (const modeling::Command& command : state.commands)
    state.project = modeling::apply(command, state.project).project;
}

SearchState ShapeEvaluator::at(const Eigen::VectorXd& y, const Job& job) const {
  SearchState state;
  const DesignSpace::Moved moved = space_.moved(y);
  state.y = moved.y;
  state.largestMovement = moved.largestMovement;
  move(moved, state);
  state.volume = modeling::volume(state.project.body);
  if (design_.smallestThickness)
    state.walls =
        wallThicknesses(std::get<modeling::Solid>(state.project.body), movingPatches_, job);
  state.model = buildTouchModel(state.project, options_, job);
  for (const TargetValue& target :
       targetValues(state.project, *state.model, design_.targets, job)) {
    state.rules.push_back(stiffnessRuleOf(target.contact));
    state.values.push_back(target.value);
  }
  return state;
}

}  // namespace palpa::app

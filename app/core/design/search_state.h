#pragma once

#include <memory>
#include <vector>

#include "app/core/design/contact_stiffness.h"
#include "app/core/design/design_space.h"
#include "app/core/design/shape_measures.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/model/touch_model.h"
#include "modeling/editing/command.h"

namespace palpa::app {

/// A shape of a search, solved.
struct SearchState {
  Eigen::VectorXd y;  ///< design variables, mm
  double largestMovement = 0;
  modeling::Project project;
  std::vector<modeling::Command> commands;  ///< from the project at y = 0
  std::shared_ptr<const TouchModel> model;
  std::vector<double> values;        ///< of the targets
  std::vector<StiffnessRule> rules;  ///< of the targets' touches
  double volume = 0;                 ///< mm^3
  std::vector<WallThickness> walls;  ///< only with Design::smallestThickness
};

/// Computes shapes of a search. The project, design and space must outlive it.
class ShapeEvaluator {
 public:
  ShapeEvaluator(const modeling::Project& project, const modeling::Design& design,
                 const DesignSpace& space, const BuildOptions& options);

  /// Throws as DesignSpace::moved(), buildTouchModel(), playTouches() and stiffnessRuleOf().
  SearchState at(const Eigen::VectorXd& y, const Job& job) const;

  /// Thickness that a wall must keep, mm: the asked one, or its own at y = 0 if that is smaller.
  /// 0 for walls that are not known.
  double leastThickness(const WallThickness& wall) const;
  void learnThicknesses(const SearchState& start);

 private:
  void move(const DesignSpace::Moved& moved, SearchState& state) const;

  const modeling::Project& project_;
  const modeling::Design& design_;
  const DesignSpace& space_;
  const BuildOptions& options_;
  std::vector<int> movingPatches_;
  std::vector<WallThickness> firstWalls_;
};

}  // namespace palpa::app

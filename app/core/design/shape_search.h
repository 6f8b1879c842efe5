#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "base/job.h"
#include "modeling/editing/command.h"
#include "modeling/editing/document.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// A shape that the search has computed.
struct ShapeStep {
  int number = 0;              ///< 0: the project as it was
  bool isAccepted = true;      ///< false: the search went back to the shape before
  std::vector<double> values;  ///< of the targets, in their order: N/mm or N; empty if not computed
  double volume = 0;           ///< mm^3
  std::optional<double> thinnest{};  ///< mm; only if a smallest thickness is asked for
  double largestMovement = 0;        ///< mm, of a control point, from the project as it was
  std::string problem{};  ///< why the shape could not be computed, for example a fold; mostly empty
  std::shared_ptr<const modeling::Solid> solid{};  ///< none if there is a problem
};

/// What keeps a search from its targets.
struct ShapeLimit {
  enum class Kind {
    kMovement,   ///< the largest movement of control points
    kThickness,  ///< the smallest thickness
    kVolume,     ///< the volume
    kFolding,    ///< shapes further on fold or cannot be solved
    kElements,   ///< the computed values jump where other elements are chosen
    kSteps,      ///< the number of steps
    kPoints,     ///< the points that may move hardly matter
    kTargets     ///< the targets contradict each other
  };
  Kind kind;
  std::string text;  ///< for users
};

/// Name of a limit in JSON: "movement", …
const char* nameOf(ShapeLimit::Kind kind);

struct ShapeResult {
  /// True if every target is met within Design::tolerance and all limits are kept. Otherwise
  /// `project` is the shape nearest to the targets among those that keep the limits, and `limits`
  /// is not empty.
  bool isReached = false;
  /// The project with moved control points, and with its touches at the same places of the
  /// material.
  modeling::Project project;
  std::vector<ShapeStep> steps;  ///< the first one is the project as it was
  ShapeStep final;               ///< of `project`
  int movedPoints = 0;
  std::vector<ShapeLimit> limits;
  /// Commands that lead from the searched project to `project`; none if nothing moved.
  std::vector<modeling::Command> commands;
};

struct ShapeSearchOptions {
  BuildOptions build;
  /// Called after each shape, on the calling thread.
  std::function<void(const ShapeStep&)> onStep;
};

/// Checks everything that can be checked without solving. Throws ModelingError that begins with the
/// path in the project file: `design.targets[0].touch: no touch is named …`.
void validateDesign(const modeling::Project& project, const modeling::Design& design);

/// Searches for a shape of the project's solid that meets the targets of `design`
/// (docs/theory.md, "Searching for a shape"): steps with a trust region; the step minimises the
/// squares of the design variables under linear equations for the logarithms of the targets, and
/// each shape is meshed, checked, assembled and solved in full. Phase of progress: "find a shape".
/// Takes about twice the time of a build per step and target. Throws as validateDesign(),
/// buildTouchModel() and StiffnessGradients for the project as it is; Cancelled.
ShapeResult findShape(const modeling::Project& project, const modeling::Design& design,
                      const ShapeSearchOptions& options = {}, const Job& job = {});

/// Applies the commands of a result to the document of the searched project as one step of undo.
void applyShape(const ShapeResult& result, modeling::Document& document);

}  // namespace palpa::app

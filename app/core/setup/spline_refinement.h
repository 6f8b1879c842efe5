#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "modeling/project/project.h"
#include "modeling/solid/knot_operations.h"

// The analysis net: the design net of a solid with knots inserted for the spline discretisation.
// The geometry stays the same; only the spaces for displacement and traction grow.
namespace palpa::app {

/// How large spline elements are to be.
struct ElementSizes {
  double interior = 0;  ///< mm, > 0: away from the borders of supports
  double turn = 0;      ///< rad, > 0: by which the surface may turn within an element
  /// Of the elements along edges where a support ends, in those they replace, (0, 1].
  double rim = 1;
  /// On the free side of these edges alone, not on patches that a support holds.
  bool isRimOutside = false;
  double border = 0;  ///< mm, > 0: across the border of a support that cuts elements
  double bump = 1;    ///< under a load that is a bump, in its radius
  /// Narrowest masks at the project's touches, in the radii these ask for; infinite: none.
  double touch = std::numeric_limits<double>::infinity();
  /// Displacement coefficients beyond which `interior` grows.
  double budget = 0;

  /// The sizes for a project's wish (MeshSettings::accuracy, elementLength) and the radius (mm) of
  /// the fingertip that shall touch it.
  static ElementSizes of(const modeling::MeshSettings& settings, double fingertipRadius);
};

/// Which knots make the analysis net of a solid.
struct SplineRefinement {
  struct Chain {
    modeling::PatchDirection first;  ///< of the chain (modeling::chainOf)
    int degree;                      ///< at least 3
    std::vector<double> knots;       ///< to insert, in the parameters of `first`, ascending
  };
  std::vector<Chain> chains;
  /// Displacement coefficients: exact but for those that are torn at borders of supports, of which
  /// it contains an estimate.
  double coefficients = 0;
  double interior = 0;  ///< mm: the size of the elements after the budget was looked at
};

/// The net for a project whose body is a solid; its patchFactors multiply sizes on patches and
/// their strips.
///
/// Every strip of patches between two rows of glued sides gets one list of knots. Each of its
/// knot spans is divided evenly, so often that the functions on any patch are about as narrow as on
/// elements of the wanted size; the outermost element along an edge where a support ends is divided
/// again, by sizes that grow by at most 2.5; elements across the border of a half space or stroke,
/// and those under a bump, are halved until they are small enough. Then elements around the touches
/// of the project are divided until these get the masks they ask for: their rows go through whole
/// strips, so doing the same everywhere would cost a multiple. All are fractions of spans by whole
/// numbers, so that a small change of the shape changes nothing in most cases, and few knots in the
/// others.
///
/// When the budget is too small, `interior` grows to three times its value first; then touches may
/// take 1.4 times the budget; then both grow.
///
/// Cost: about 60 µs per knot span of a patch, more where borders of supports cross patches.
/// @throws ModelingError (tooLarge) when a strip would need too many rows
SplineRefinement splineRefinement(const modeling::Project& project, const ElementSizes& sizes);

/// The same surface with the net's degrees and knots.
modeling::Solid refined(const modeling::Solid& solid, const SplineRefinement& net);

}  // namespace palpa::app

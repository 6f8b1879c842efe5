#pragma once

#include <limits>
#include <vector>

#include "modeling/project/project.h"
#include "modeling/solid/knot_operations.h"
#include "modeling/solid/surface_evaluator.h"

// The analysis net: the design net of a solid with knots inserted for the spline discretisation.
// The geometry stays the same; only the spaces for displacement and traction grow.
namespace palpa::app {

/// Requested sizes of spline elements.
struct ElementSizes {
  double interior = 0;  ///< mm, > 0: away from the borders of supports
  double turn = 0;      ///< rad, > 0: maximum rotation of the surface's normal within an element
  /// Size of the outermost element along an edge where a support ends, over the size of the element
  /// that it replaces, (0, 1].
  double rim = 1;
  /// True to refine only the free side of these edges, not the patches that a support fixes.
  bool isRimOutside = false;
  double border = 0;  ///< mm, > 0: across the border of a support that cuts elements
  double bump = 1;    ///< under a load that is a bump, over the bump's radius
  /// Narrowest masks at the project's touches, over the radii of the touches; infinite: none.
  double touch = std::numeric_limits<double>::infinity();
  /// Number of displacement coefficients beyond which `interior` grows.
  double budget = 0;

  /// The sizes for a project's settings (MeshSettings::accuracy, splineDensity, elementLength) and
  /// for touches with a fingertip of the given radius (mm).
  static ElementSizes of(const modeling::MeshSettings& settings, double fingertipRadius);
};

/// Knots and degrees that make the analysis net of a solid.
struct SplineRefinement {
  struct Chain {
    modeling::PatchDirection first;  ///< of the chain (modeling::chainOf)
    int degree;                      ///< at least 3
    std::vector<double> knots;       ///< to insert, in the parameters of `first`, ascending
  };
  std::vector<Chain> chains;
  /// Number of displacement coefficients: exact except for the coefficients that borders of
  /// supports double, which are estimated.
  double coefficients = 0;
  double interior = 0;    ///< mm: element size that meets the budget
  bool hasRoots = false;  ///< haveRoots() of the project's supports
};

/// The analysis net of a project whose body is a solid; `surface` evaluates this solid. The
/// project's patchFactors multiply sizes on patches and on the chains through them.
///
/// Each chain (knot_chains.h) gets one list of knots, in four steps:
/// 1. Each knot span is divided evenly, so often that the functions on any patch are about as
/// narrow
///    as on elements of the requested size.
/// 2. The outermost element along an edge where a support ends is divided again, into elements that
///    grow by at most 2.5.
/// 3. Elements across the border of a half space or stroke, and under a bump, are halved until they
///    are small enough.
/// 4. Elements around the project's touches are divided until the touches get the masks they ask
///    for. These rows run through whole chains, so the same refinement everywhere would cost a
///    multiple.
/// All knots are fractions of spans by whole numbers, so a small change of the shape changes no
/// knots in most cases and few in the others.
///
/// If the budget is too small, `interior` grows to three times its value first; then touches may
/// take 1.4 times the budget; then both grow.
///
/// Cost: about 60 µs per knot span of a patch, more where borders of supports cross patches.
/// Throws ModelingError (kTooLarge) if a chain would need too many rows.
SplineRefinement splineRefinement(const modeling::Project& project,
                                  const modeling::SurfaceEvaluator& surface,
                                  const ElementSizes& sizes);

/// The same surface with the degrees and knots of the refinement.
modeling::Solid refined(const modeling::Solid& solid, const SplineRefinement& refinement);

}  // namespace palpa::app

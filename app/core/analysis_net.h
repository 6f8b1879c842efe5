#pragma once
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
  double border = 0;  ///< mm, > 0: across the border of a support that cuts elements

  /// The sizes for a project's wish (MeshSettings::accuracy, elementLength) and the radius (mm) of
  /// the fingertip that shall touch it.
  static ElementSizes of(const modeling::MeshSettings& settings, double fingertipRadius);
};

/// Which knots make the analysis net of a solid.
struct AnalysisNet {
  struct Chain {
    modeling::PatchDirection first;  ///< of the chain (modeling::chainOf)
    int degree;                      ///< at least 3
    std::vector<double> knots;       ///< to insert, in the parameters of `first`, ascending
  };
  std::vector<Chain> chains;
  /// Displacement coefficients; borders of supports that cut elements add some to them.
  double coefficients = 0;
};

/// The net for a solid that is held in some regions. `settings`: its patchFactors multiply sizes on
/// patches and their strips.
///
/// Every strip of patches between two rows of glued sides gets one list of knots. Each of its
/// knot spans is divided evenly, as often as its longest part on any patch needs; the outermost
/// element along an edge where a support ends is divided again, by sizes that grow by at most
/// kMostGrowth; elements across the border of a half space or stroke are halved until they are
/// small enough. All are fractions of spans by whole numbers, so that a small change of the
/// shape changes nothing in most cases, and few knots in the others.
///
/// Cost: about 60 µs per knot span of a patch, more where borders of supports cross patches.
/// @throws ModelingError (tooLarge) when a strip would need more than kMostNetRows rows
AnalysisNet analysisNet(const modeling::Solid& solid, std::span<const modeling::Region> supports,
                        const ElementSizes& sizes, const modeling::MeshSettings& settings);
/// The net for a project whose body is a solid.
AnalysisNet analysisNet(const modeling::Project& project, double fingertipRadius);

/// The same surface with the net's degrees and knots.
modeling::Solid refined(const modeling::Solid& solid, const AnalysisNet& net);

}  // namespace palpa::app

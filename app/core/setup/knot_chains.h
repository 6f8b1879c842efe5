#pragma once

#include <array>
#include <vector>

#include "modeling/solid/knot_operations.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {

/// A strip of patches between two rows of glued sides. All directions along it share knots. A place
/// along it is the number of a span of the design knots of its first link plus a fraction.
struct KnotChain {
  std::vector<modeling::ChainLink> links;
  /// Maxima over some lines along a span of a link.
  struct Span {
    double length = 0;  ///< mm
    double turn = 0;    ///< rad
  };
  std::vector<std::vector<Span>> spans;  ///< per link, in the order of the first link's spans
  int spanCount() const { return static_cast<int>(spans.front().size()); }
};

/// All chains of a solid's design net. Immutable; the surface must outlive it.
class KnotChains {
 public:
  /// About 60 µs per knot span of a patch.
  KnotChains(const modeling::Solid& solid, const modeling::SurfaceEvaluator& surface);

  int count() const { return static_cast<int>(chains_.size()); }
  const KnotChain& operator[](int chain) const { return chains_[chain]; }
  /// The chain of a direction of a patch.
  int of(modeling::PatchDirection at) const { return chainOf_[at.patch][at.direction]; }
  const modeling::ChainLink& linkOf(modeling::PatchDirection at) const;

  /// Largest extent of a patch in a direction, mm.
  double extent(modeling::PatchDirection at) const;
  /// The place along its chain of a parameter of a patch's direction.
  double placeOf(modeling::PatchDirection at, double parameter) const;
  /// The inverse of placeOf().
  double parameterOf(modeling::PatchDirection at, double place) const;

 private:
  const modeling::SurfaceEvaluator& surface_;
  std::vector<std::array<int, 2>> chainOf_;
  std::vector<KnotChain> chains_;
};

}  // namespace palpa::app

#pragma once

#include <array>
#include <vector>

#include "modeling/solid/knot_operations.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {

/// A strip of patches between two rows of glued sides. All directions along it share knots; places
/// along it are numbers of a span of its first link's design knots plus a fraction.
struct KnotChain {
  std::vector<modeling::ChainLink> links;
  /// The longest and the most curved of some lines along a span of a link.
  struct Span {
    double length = 0;  ///< mm
    double turn = 0;    ///< rad
  };
  std::vector<std::vector<Span>> spans;  ///< of each link, in the order of the first one's
  int spanCount() const { return static_cast<int>(spans.front().size()); }
};

/// All strips of a solid's design net. Immutable; the surface must outlive it.
class KnotChains {
 public:
  /// About 60 µs per knot span of a patch.
  KnotChains(const modeling::Solid& solid, const modeling::SurfaceEvaluator& surface);

  int count() const { return static_cast<int>(strips_.size()); }
  const KnotChain& operator[](int strip) const { return strips_[strip]; }
  /// The strip that a direction of a patch belongs to.
  int of(modeling::PatchDirection at) const { return stripOf_[at.patch][at.direction]; }
  const modeling::ChainLink& linkOf(modeling::PatchDirection at) const;

  /// Largest extent of a patch in a direction, mm.
  double extent(modeling::PatchDirection at) const;
  /// A parameter of a patch's direction as a place along its strip.
  double placeOf(modeling::PatchDirection at, double parameter) const;
  /// The other way round.
  double parameterOf(modeling::PatchDirection at, double place) const;

 private:
  const modeling::SurfaceEvaluator& surface_;
  std::vector<std::array<int, 2>> stripOf_;
  std::vector<KnotChain> strips_;
};

}  // namespace palpa::app

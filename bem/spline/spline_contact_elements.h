#pragma once

#include "bem/element/contact_elements.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Precomputed data of each element of a spline surface for contacts, and the adjacency of the
/// elements. Immutable.
class SplineContactElements final : public ContactElements {
 public:
  /// `narrowest`: one radius per displacement coefficient, mm. Bumps of at least this radius are
  /// integrated accurately.
  SplineContactElements(const SplineSurface& surface, const SplineTractions& tractions,
                        const std::vector<double>& narrowest);

 private:
  void connectCells(const SplineSurface& surface);
  Eigen::VectorXd fill(const SplineSurface& surface, const SplineTractions& tractions, int index,
                       const std::vector<double>& narrowest);
};

}  // namespace palpa::bem

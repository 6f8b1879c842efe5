#pragma once

#include <array>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::app {

/// Colour scale of a stiffness map: logarithmic, because stiffness differs by ratios, and limited
/// to the values of nearly all of the surface, because stiffness grows without bound towards
/// supports.
struct StiffnessColours {
  /// N/mm, ends of the scale, 0 < low < high: numbers with few digits that enclose the softest
  /// place and the stiffness that 95 % of the free surface do not exceed.
  std::array<double, 2> range{1, 10};
  bool isCapped = false;  ///< true if stiffer places exist; they get the colour of the upper end

  /// From bem::StiffnessMap::compliances(); unknown values are left out.
  static StiffnessColours of(const bem::BoundaryMesh& mesh, const bem::TractionSlots& slots,
                             const std::vector<double>& compliances);

  /// Limits values to the upper end; NaN stays.
  void cap(std::vector<double>& stiffnesses) const;
};

}  // namespace palpa::app

#pragma once

#include <array>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::app {

/// How a stiffness map is coloured: on a logarithmic scale, as stiffness differs by ratios, and
/// only up to what nearly all of the surface has, as it grows without bound towards supports.
struct StiffnessColours {
  /// N/mm, ends of the colours, 0 < low < high: numbers with few digits around the softest place
  /// and around what 95 % of the free surface do not exceed.
  std::array<double, 2> range{1, 10};
  bool isCapped = false;  ///< stiffer places exist and are drawn like the upper end

  /// From bem::StiffnessMap::compliances(); what is not known yet does not count.
  static StiffnessColours of(const bem::BoundaryMesh& mesh, const bem::TractionSlots& slots,
                             const std::vector<double>& compliances);

  /// Values above the range become its end; NaN stays.
  void cap(std::vector<double>& stiffnesses) const;
};

}  // namespace palpa::app

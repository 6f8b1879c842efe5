#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "bem/element/element_equations.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/collocation.h"
#include "bem/model/element_part.h"
#include "bem/quadratic/quadratic_discretisation.h"

// What differs between two shapes of the same discretised body: the part of the operators that an
// incremental update integrates again.
namespace palpa::bem {

/// Moved part of a discretisation.
struct MovedPart {
  std::vector<bool> isOwnRow;  ///< by equation: integrated from scratch
  ElementPart moved;

  std::vector<int> equations() const { return indicesWhere(isOwnRow); }
  std::vector<int> others() const { return indicesWhere(isOwnRow, false); }

  /// Share of the work of a full assembly: integrated rows, and moved elements for the other rows
  /// before and after the motion.
  double share(int elementCount) const {
    const auto count = static_cast<double>(isOwnRow.size());
    const double rows = static_cast<double>(std::count(isOwnRow.begin(), isOwnRow.end(), true));
    return rows / count + 2 * (1 - rows / count) * static_cast<double>(moved.elements.size()) /
                              std::max(elementCount, 1);
  }
};

/// For linear functions on triangles; none if the meshes differ in more than the positions of their
/// nodes. `slots`: of `mesh`. `points`: of the equations.
std::optional<MovedPart> findMovedPart(const BoundaryMesh& before, const BoundaryMesh& mesh,
                                       const TractionSlots& slots,
                                       const std::vector<CollocationPoint>& pointsBefore,
                                       const std::vector<CollocationPoint>& points);

/// For functions on elements. `elements`: those that moved; none if the surfaces differ in more
/// than their positions. None, too, if the equations are others.
std::optional<MovedPart> findMovedPart(std::optional<std::vector<int>> elements,
                                       const ElementSurface& surface,
                                       const WeightedEquations& equationsBefore,
                                       const WeightedEquations& equations);

/// Elements of which a node moved; none if nodes, elements, groups or tags differ.
std::optional<std::vector<int>> movedElements(const QuadraticDiscretisation& before,
                                              const QuadraticDiscretisation& after);

}  // namespace palpa::bem

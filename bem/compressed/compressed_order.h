#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/byte_stream.h"
#include "bem/element/element_equations.h"
#include "bem/element/element_surface.h"
#include "bem/linalg/cluster_tree.h"
#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Order of rows and columns of compressed operators: by the positions of nodes in a cluster tree.
/// The columns of a cluster are contiguous among the displacement coefficients, and among the
/// slots; its rows belong to the points near its nodes.
struct CompressedOrder {
  ClusterTree tree;                          ///< of the nodes
  std::vector<int> slots, slotPositionOf;    ///< by position; position of each
  std::vector<int> firstSlot;                ///< of each node position, and the end
  std::vector<int> points, pointPositionOf;  ///< likewise for the points of the equations
  std::vector<int> firstPoint;

  std::size_t positionCount() const { return tree.order().size(); }  ///< of the nodes
  /// Numbers of columns of a cluster: 3 per displacement coefficient, then 3 per slot.
  int nodeColumns(int cluster) const { return 3 * tree.cluster(cluster).size(); }
  int slotColumns(int cluster) const {
    const auto& c = tree.cluster(cluster);
    return 3 * (firstSlot[c.end] - firstSlot[c.begin]);
  }
  int columns(int cluster) const { return nodeColumns(cluster) + slotColumns(cluster); }
  int pointBegin(int cluster) const { return firstPoint[tree.cluster(cluster).begin]; }
  int pointEnd(int cluster) const { return firstPoint[tree.cluster(cluster).end]; }
  int rows(int cluster) const { return 3 * (pointEnd(cluster) - pointBegin(cluster)); }
};

void write(const CompressedOrder& order, const ByteSink& sink);
/// Throws DamagedData, and what the source throws.
CompressedOrder readCompressedOrder(const ByteSource& source);

/// Order of the columns of `nodes` (positions of the displacement coefficients) and `slots`, and of
/// the points of the equations. Leaves of the tree have 20 to 40 nodes.
CompressedOrder makeCompressedOrder(const ElementSurface& surface,
                                    const WeightedEquations& equations,
                                    const std::vector<Eigen::Vector3d>& nodes,
                                    const TractionSlots& slots);

}  // namespace palpa::bem

#pragma once

#include <span>
#include <vector>

#include "bem/compressed/cluster_tree.h"
#include "bem/element/element_rows.h"

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

/// Integrals of Kelvin's kernels at points over the functions of a cluster: parts of the rows of
/// [-H G]. All references must outlive the object; const use from several threads is safe.
class ExactRows {
 public:
  ExactRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
            const KelvinConstants& constants, const CompressedOrder& order);

  struct Scratch {
    std::unique_ptr<ElementQuadrature::Workspace> quadrature;
    std::vector<double> T, U;
    std::vector<int> places;
  };
  Scratch makeScratch() const;

  /// Elements with functions of a cluster, ascending.
  std::span<const int> elements(int cluster) const { return elements_[cluster]; }

  /// The three rows of a point at the columns of a cluster, row by row; without the elements
  /// `leftOut` (ascending).
  void compute(const CollocationPlace& point, int cluster, std::span<const int> leftOut,
               Scratch& scratch, float* rows) const;

 private:
  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const KelvinConstants constants_;
  const CompressedOrder& order_;
  KelvinSumLoops loops_;
  std::vector<std::vector<int>> elements_;
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/job.h"
#include "bem/compressed/block_division.h"
#include "bem/compressed/block_share.h"
#include "bem/compressed/cluster_basis.h"
#include "bem/compressed/exact_rows.h"
#include "bem/linalg/graded_rows.h"
#include "bem/linalg/row_choice.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Low-rank block U^T V of the points of a cluster and the functions of another one.
struct FarBlock {
  int column;                       ///< cluster of functions
  GradedRows U;                     ///< (rank, rows)
  GradedRows ofNodes{}, ofSlots{};  ///< V: (rank, columns of each kind), whose numbers differ in
                                    ///< size; empty if V = coefficients * basis of the cluster
  GradedRows coefficients{};        ///< (rank, size of the basis), or empty
  int rank() const { return U.rowCount(); }
  bool isCombined() const { return coefficients.rowCount() > 0; }
  std::size_t bytes() const {
    return U.bytes() + ofNodes.bytes() + ofSlots.bytes() + coefficients.bytes();
  }
};

/// All blocks.
struct FarBlocks {
  std::vector<std::vector<FarBlock>> blocks;  ///< per cluster of points
  std::vector<ClusterBasis> bases;            ///< per cluster of functions; empty without one
};

/// What makeFarBlocks() reads.
struct FarBlockInputs {
  const CompressedOrder& order;
  const BlockDivision& division;
  const ExactRows& exact;
  const WeightedEquations& equations;
  const std::vector<Eigen::Vector3d>& points;  ///< positions in the order of `order`, mm
  const std::vector<Eigen::Vector3d>& nodes;   ///< positions of the functions, in their own order
  const TractionSlots& slots;
  const KelvinConstants& constants;
  double shear;      ///< MPa
  double tolerance;  ///< of each block, relative
  BlockShare share;  ///< the blocks that are made
  bool hasBases;     ///< whether V is combined from bases where that takes less memory
};

/// The blocks of all distant pairs of the share, per cluster of points. Rows of the operators far
/// from a cluster of functions are smooth functions of the point: in each cluster of points a
/// skeleton is chosen, from the leaves up, then from its rows for each block those from which the
/// fields of its functions are interpolated; only their integrals are computed. The choices use
/// kernels at points instead of integrals. Throws Cancelled.
FarBlocks makeFarBlocks(const FarBlockInputs& inputs, const Job& job);

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/job.h"
#include "bem/compressed/block_division.h"
#include "bem/compressed/block_share.h"
#include "bem/compressed/exact_rows.h"
#include "bem/linalg/packed_numbers.h"
#include "bem/linalg/row_choice.h"
#include "bem/model/boundary_mesh.h"
#include "bem/model/material.h"

namespace palpa::bem {

/// Low-rank block U V of the points of a cluster and the functions of another one.
struct FarBlock {
  int column;       ///< cluster of functions
  int rank = 0;     ///< of the block
  PackedNumbers U;  ///< (rows, rank), by rows
  PackedNumbers V;  ///< (rank, columns), by columns
  /// Errors of U are noise in the equations, errors of V are the same for all points of the cluster
  /// and do not average out.
  static constexpr auto kBitsOfU = PackedNumbers::Bits::k16, kBitsOfV = PackedNumbers::Bits::k24;
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
};

/// The blocks of all distant pairs of the share, per cluster of points. Rows of the operators far
/// from a cluster of functions are smooth functions of the point: in each cluster of points a
/// skeleton is chosen, from the leaves up, then from its rows for each block those from which the
/// fields of its functions are interpolated; only their integrals are computed. The choices use
/// kernels at points instead of integrals. Throws Cancelled.
std::vector<std::vector<FarBlock>> makeFarBlocks(const FarBlockInputs& inputs, const Job& job);

}  // namespace palpa::bem

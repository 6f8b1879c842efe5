#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "bem/linalg/graded_rows.h"

namespace palpa::bem {

/// Rows of which the right factors V of several low-rank blocks of one cluster of functions are
/// combined (a cluster basis; Hackbusch and Börm 2002).
struct ClusterBasis {
  GradedRows ofNodes, ofSlots;  ///< (size, columns of each kind)

  int size() const { return ofNodes.rowCount(); }
  std::size_t bytes() const { return ofNodes.bytes() + ofSlots.bytes(); }
};

/// The right factor of a block before it is stored.
struct RightFactor {
  RowMatrixXf V;                          ///< (rank, columns)
  std::vector<PackedNumbers::Bits> bits;  ///< of each row, falling
};

struct CombinedFactors {
  ClusterBasis basis;
  std::vector<GradedRows> coefficients;  ///< V of each factor: (rank, size of the basis)
};

/// A basis of the rows of all factors, which combinations of it give within 2^-21 of the largest
/// row of each; nothing if the factors are stored in less memory, or contain what is not finite.
/// `columnsOfSlots`: the last ones of V; `importance`: factor that makes these columns comparable
/// with the others; `seed`: of the random combinations that are looked at.
std::optional<CombinedFactors> combineFactors(std::span<const RightFactor* const> factors,
                                              Eigen::Index columnsOfSlots, float importance,
                                              unsigned seed);

}  // namespace palpa::bem

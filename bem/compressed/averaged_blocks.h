#pragma once

#include <cstddef>
#include <span>

#include "base/job.h"
#include "bem/compressed/block_rows.h"
#include "bem/compressed/compressed_order.h"
#include "bem/element/averaged_rows.h"

namespace palpa::bem {

/// N, by kinds of columns. The blocks of Kelvin's U, which equations and functions weigh with
/// numbers, are symmetric.
struct AveragedBlocks {
  BlockRows<PackedBlock> ofNodes;           ///< columns: node positions; the last block of a row
                                            ///< corrects its sum, see packRow()
  BlockRows<PackedSymmetricBlock> ofSlots;  ///< columns: node count + slot positions

  std::size_t bytes() const { return ofNodes.bytes() + ofSlots.bytes(); }
};

/// What averaged elements add to the rows of their equations near to them, columns in an order.
/// `rows`: of all elements; `totals`: see AveragedRows::blocks(); `isWanted`: per equation, the
/// others get no blocks. Throws Cancelled.
AveragedBlocks makeAveragedBlocks(const CompressedOrder& order, const ElementSurface& surface,
                                  const WeightedEquations& equations, const AveragedRows& rows,
                                  std::span<const AveragedRows::Total> totals,
                                  const std::vector<char>& isWanted, const Job& job);

}  // namespace palpa::bem

#pragma once

#include <span>

#include "base/job.h"
#include "bem/compressed/block_rows.h"
#include "bem/compressed/compressed_order.h"
#include "bem/element/averaged_rows.h"

namespace palpa::bem {

/// What averaged elements add to the rows of their equations near to them, columns in an order.
/// `rows`: of all elements; `totals`: see AveragedRows::blocks(); `isWanted`: per equation, the
/// others get no blocks. Throws Cancelled.
BlockRows makeAveragedBlocks(const CompressedOrder& order, const ElementSurface& surface,
                             const WeightedEquations& equations, const AveragedRows& rows,
                             std::span<const AveragedRows::Total> totals,
                             const std::vector<char>& isWanted, const Job& job);

}  // namespace palpa::bem

#include "bem/compressed/block_share.h"

#include <bit>
#include <cstdint>

#include "bem/linalg/cluster_tree.h"

namespace palpa::bem {

bool BlockShare::hasBlock(int cluster, std::size_t block) const {
  if (isWhole()) return true;
  const int level = std::bit_width(static_cast<unsigned>(cluster) + 1) - 1;
  const std::int64_t of = ClusterTree::countOf(level), k = cluster - ClusterTree::firstOf(level);
  const std::int64_t first = k * count_ / of, last = ((k + 1) * count_ - 1) / of;
  return first + static_cast<std::int64_t>(block) % (last - first + 1) == index_;
}

}  // namespace palpa::bem

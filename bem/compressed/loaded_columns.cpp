#include "bem/compressed/loaded_columns.h"

namespace palpa::bem {

LoadedColumns::LoadedColumns(const CompressedOrder& order, const RowMatrixXf& x)
    : tree_(order.tree), isLoaded_(order.positionCount() + order.slots.size()) {
  for (std::size_t k = 0; k < isLoaded_.size(); ++k)
    isLoaded_[k] = x.middleRows<3>(3 * static_cast<Eigen::Index>(k)).isZero(0) ? 0 : 1;
  before_.reserve(order.positionCount() + 1);
  for (std::size_t k = 0; k < order.positionCount(); ++k) {
    bool any = isLoaded_[k] != 0;
    for (int slot = order.firstSlot[k]; slot < order.firstSlot[k + 1]; ++slot)
      any = any || isLoaded_[order.positionCount() + static_cast<std::size_t>(slot)] != 0;
    before_.push_back(before_.back() + (any ? 1 : 0));
  }
}

}  // namespace palpa::bem

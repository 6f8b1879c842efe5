#include "bem/compressed/low_rank_tile.h"

#include <utility>

#include "bem/linalg/single_precision.h"

namespace palpa::bem {

using Eigen::MatrixXf;

void transpose(LowRankTile& tile) {
  if (tile.isDense())
    tile.X.transposeInPlace();
  else
    std::swap(tile.X, tile.Y);
}

MatrixXf toDense(LowRankTile tile) {
  if (tile.isDense()) return std::move(tile.X);
  MatrixXf result;
  multiply(false, true, 1, tile.X, tile.Y, 0, result);
  return result;
}

}  // namespace palpa::bem

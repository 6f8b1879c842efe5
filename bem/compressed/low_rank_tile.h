#pragma once

#include <Eigen/Core>

namespace palpa::bem {

/// X Y^T, or the dense X where Y is empty; zero where both are.
struct LowRankTile {
  Eigen::MatrixXf X, Y;
  bool isDense() const { return Y.size() == 0 && X.size() > 0; }
  bool isZero() const { return X.size() == 0; }
};

/// Swaps rows and columns of a tile.
void transpose(LowRankTile& tile);

/// The numbers of a tile that is not zero.
Eigen::MatrixXf toDense(LowRankTile tile);

}  // namespace palpa::bem

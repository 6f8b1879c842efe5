#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/job.h"
#include "bem/compressed/low_rank_tile.h"

namespace palpa::bem {

/// The second factors of products A B that the tiles of one row or column of a factorisation
/// share, and what random vectors, which the tiles share too, become under them.
struct SharedFactors {
  std::vector<LowRankTile> factors;
  Eigen::MatrixXf random;
  std::vector<Eigen::MatrixXf> onRandom;  ///< Y^T random, or X random where a factor is dense

  /// Draws the random vectors for factors with that many columns.
  void draw(Eigen::Index columns, unsigned seed);
};

/// A tile minus a sum of products of tiles, base - Σ A B, which is never formed unless its rank is
/// high: it is sampled with random vectors (Halko, Martinsson and Tropp 2011).
class TileDifference {
 public:
  /// `left`: the factors A, as many as the shared ones B. These and the job must outlive the
  /// object.
  TileDifference(LowRankTile base, std::vector<LowRankTile> left, const SharedFactors& right,
                 const Job& job);

  /// As a product of narrow matrices whose error has at most the norm `tolerance`, as random
  /// vectors find it, or dense where that is shorter. Throws Cancelled.
  LowRankTile compress(float tolerance, unsigned seed) &&;

 private:
  /// `onRight`: see SharedFactors::onRandom.
  Eigen::MatrixXf sample(const Eigen::MatrixXf& x,
                         const std::vector<Eigen::MatrixXf>& onRight) const;
  Eigen::MatrixXf sampleTransposed(const Eigen::MatrixXf& x) const;
  Eigen::MatrixXf dense() &&;

  LowRankTile base_;
  std::vector<LowRankTile> left_;
  const SharedFactors& right_;
  const Job& job_;
  std::vector<Eigen::MatrixXf> middles_;  ///< between the outer factors of A B, if both are narrow
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Core>
#include <vector>

#include "bem/linalg/graded_rows.h"

namespace palpa::bem {

/// Errors that rounding may make, relative to the largest summand. Errors of U are noise in the
/// equations; errors of V are the same for all points of the cluster and do not average out.
inline constexpr double kErrorOfU = 0x1p-15, kErrorOfV = 0x1p-21;

/// Bits with which rows of these sizes have errors below `error`; falling.
std::vector<PackedNumbers::Bits> bitsFor(const Eigen::VectorXd& sizes, double error);

/// A product U^T V of few rows whose summands fall, and the bits that they need.
struct FallingFactors {
  RowMatrixXf U, V;
  std::vector<PackedNumbers::Bits> bitsOfU, bitsOfV;  ///< of each row, falling
};

/// Factors with the product U^T V (within 1e-6 of its size), turned by the eigenvectors of V V^T,
/// so that the summands fall like the singular values. `importance`: factor that makes the last
/// `columnsOfV2` columns of V comparable with the others.
FallingFactors fallingFactors(const RowMatrixXf& U, const RowMatrixXf& V, Eigen::Index columnsOfV2,
                              float importance);

}  // namespace palpa::bem

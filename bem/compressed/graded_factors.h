#pragma once

#include <Eigen/Core>

#include "bem/linalg/graded_rows.h"

namespace palpa::bem {

/// A product U^T [V1 V2] of few rows, packed so that each summand of a row of U and a row of V has
/// the digits that its size needs.
struct GradedFactors {
  GradedRows U, V1, V2;
};

/// Factors with the product U^T V (within 1e-6 of its size). V2 are the last `columnsOfV2` columns
/// of V; `importance`: factor that makes them comparable with the others. The factors are turned by
/// the eigenvectors of V V^T, so that the summands fall like the singular values.
GradedFactors gradedFactors(const RowMatrixXf& U, const RowMatrixXf& V, Eigen::Index columnsOfV2,
                            float importance);

}  // namespace palpa::bem

#pragma once

#include <vector>

namespace palpa::bem {

/// Gauss-Legendre rule on [0, 1]; the weights sum to 1.
struct GaussRule {
  std::vector<double> points, weights;
};

inline constexpr int kMaxGaussPoints = 24;

/// Rule with `count` (1 … 24) points, exact for polynomials of degree 2 count - 1. Every rule is
/// computed once. Throws std::out_of_range if `count` is out of range.
const GaussRule& gaussRule(int count);

}  // namespace palpa::bem

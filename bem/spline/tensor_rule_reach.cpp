#include "bem/spline/tensor_rule_reach.h"

#include <algorithm>
#include <cmath>

namespace palpa::bem {

double tensorRuleReach(int points, int degree, double error) {
  const double rho = std::pow(12 / error, 1.0 / (2 * points)) / 0.93;
  const double left = std::max(2 * points - degree, 1);
  return std::max((rho + 1 / rho) / 2, std::pow(0.1 * std::pow(3.0, 3 - points) / error, 1 / left));
}

}  // namespace palpa::bem

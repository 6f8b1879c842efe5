#include "bem/element/element_points.h"

namespace palpa::bem {

void ElementRule::clear() {
  u.clear();
  v.clear();
  weight.clear();
}

void ElementRule::add(double atU, double atV, double ofWeight) {
  u.push_back(atU);
  v.push_back(atV);
  weight.push_back(ofWeight);
}

int ElementRule::pad() {
  const int count = roundUpToLanes(static_cast<int>(u.size()));
  u.resize(static_cast<std::size_t>(count), u.front());
  v.resize(static_cast<std::size_t>(count), v.front());
  weight.resize(static_cast<std::size_t>(count), 0);
  return count;
}

void ElementPoints::basisAt(int point, Eigen::VectorXd& values) const {
  values.resize(functionCount());
  if (perDirection == 0) {
    values = Eigen::Map<const Eigen::VectorXd>(
        basis.data() + static_cast<std::ptrdiff_t>(point) * stride, values.size());
    return;
  }
  const int n = perDirection;
  const double* alongU = basis.data() + static_cast<std::ptrdiff_t>(point % n) * functions[0];
  const double* alongV = basis.data() + static_cast<std::ptrdiff_t>(n) * functions[0] +
                         static_cast<std::ptrdiff_t>(point / n) * functions[1];
  for (int f = 0; f < functionCount(); ++f)
    values[f] = alongU[f % functions[0]] * alongV[f / functions[0]];
}

SumKernelsTask ElementPoints::sumTask(const Eigen::Vector3d& x, KernelSums* sums) const {
  return {x.data(),
          used,
          count,
          geometry.data(),
          perDirection,
          {basis.data(), basis.data() + static_cast<std::ptrdiff_t>(perDirection) * functions[0]},
          {functions[0], functions[1]},
          stride,
          sums};
}

}  // namespace palpa::bem

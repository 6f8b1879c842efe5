#pragma once

#include <Eigen/Core>
#include <vector>

namespace palpa::bem {

/// Copies the coefficients (3 numbers each) of a list, for example of the functions of an element,
/// into columns.
inline void gather(const Eigen::VectorXd& from, const std::vector<int>& list,
                   Eigen::Matrix3Xd& to) {
  to.resize(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t f = 0; f < list.size(); ++f)
    to.col(static_cast<Eigen::Index>(f)) = from.segment<3>(3 * static_cast<Eigen::Index>(list[f]));
}

inline Eigen::Matrix3Xd gather(const Eigen::VectorXd& from, const std::vector<int>& list) {
  Eigen::Matrix3Xd columns;
  gather(from, list, columns);
  return columns;
}

}  // namespace palpa::bem

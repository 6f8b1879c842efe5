#pragma once

#include <Eigen/Dense>
#include <cstring>
#include <vector>

#include "bem/base/team.h"

namespace palpa::bem {

/// Plain values in the bytes that a team exchanges.
template <class Value>
void appendValues(const Value* values, std::size_t count, Team::Bytes& to) {
  const auto* bytes = reinterpret_cast<const std::byte*>(values);
  to.insert(to.end(), bytes, bytes + count * sizeof(Value));
}

/// Sum of the members' matrices of one size, in the order of the members: the same for all.
template <class Matrix>
Matrix sumOverTeam(const Team& team, const Matrix& own) {
  Team::Bytes bytes;
  appendValues(own.data(), static_cast<std::size_t>(own.size()), bytes);
  Matrix sum = Matrix::Zero(own.rows(), own.cols()), part = sum;
  for (const Team::Bytes& each : team.gather(bytes)) {
    std::memcpy(part.data(), each.data(), each.size());
    sum += part;
  }
  return sum;
}

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "bem/model/derived_quantities.h"
#include "bem/triangle/interior_kernel.h"

namespace palpa::bem {

/// Quadrature points with values of a field, in the layout of interior_kernel.h.
class InteriorSources {
 public:
  void resize(std::size_t count) {
    count_ = count;
    stride_ = count + kSourcePadding;
    // The padding is read, but multiplied by zero: it must be finite and no interior point.
    values_.assign(kSourceValues * stride_, 1e9);
  }
  void clear() { count_ = 0; }
  std::size_t count() const { return count_; }
  /// Makes room for `count` sources without a size; keep the count with set().
  void reserve(std::size_t count) {
    if (stride_ < count + kSourcePadding) resize(count);
    count_ = 0;
  }

  void set(std::size_t index, const Eigen::Vector3d& position, const Eigen::Vector3d& area,
           const Eigen::Vector3d& displacement, const Eigen::Vector3d& force) {
    double* at = values_.data() + index;
    for (const Eigen::Vector3d* part : {&position, &area, &displacement, &force})
      for (int i = 0; i < 3; ++i, at += stride_) *at = (*part)[i];
  }
  /// Index of one more source, for set().
  std::size_t append() { return count_++; }

  InteriorSumTask task(const InteriorConstants& constants, std::size_t first, std::size_t count,
                       const LinearState& linear, const Eigen::Vector3d& x, double* displacement,
                       double* stress) const {
    return {constants,
            x.data(),
            values_.data() + first,
            static_cast<long>(stride_),
            static_cast<int>(count),
            &linear,
            displacement,
            stress};
  }

 private:
  std::size_t count_ = 0, stride_ = 0;
  std::vector<double> values_;
};

/// Sums of one interior point.
struct InteriorSums {
  std::array<double, 3> displacement{};
  std::array<double, 6> stress{};

  InteriorState state() const {
    InteriorState result;
    result.displacement = Eigen::Vector3d(displacement.data());
    result.stress << stress[0], stress[1], stress[3], stress[1], stress[2], stress[4], stress[3],
        stress[4], stress[5];
    return result;
  }
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <memory>

namespace palpa::bem {

namespace detail {
/// Zeroed memory from the operating system, in huge pages if available. Throws std::bad_alloc.
void* allocatePages(std::size_t bytes);
void releasePages(void* memory, std::size_t bytes) noexcept;
}  // namespace detail

/// Dense column-major matrix for the operators, which take hundreds of megabytes. Initially zero,
/// movable, not copyable. Huge pages, because page faults of ordinary heap memory of this size cost
/// more than the computation of the integrals.
template <class Scalar>
class LargeMatrix {
 public:
  using Map = Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
  using ConstMap = Eigen::Map<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;

  LargeMatrix() = default;
  LargeMatrix(Eigen::Index rows, Eigen::Index cols)
      : rows_(rows), cols_(cols), memory_(nullptr, Release{bytes()}) {
    if (bytes() > 0) memory_.reset(static_cast<Scalar*>(detail::allocatePages(bytes())));
  }

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return cols_; }
  std::size_t bytes() const {
    return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_) * sizeof(Scalar);
  }
  Scalar* data() { return memory_.get(); }
  const Scalar* data() const { return memory_.get(); }
  Map view() { return {data(), rows_, cols_}; }
  ConstMap view() const { return {data(), rows_, cols_}; }

 private:
  struct Release {
    std::size_t bytes = 0;
    void operator()(Scalar* memory) const noexcept { detail::releasePages(memory, bytes); }
  };
  Eigen::Index rows_ = 0, cols_ = 0;
  std::unique_ptr<Scalar[], Release> memory_;
};

}  // namespace palpa::bem

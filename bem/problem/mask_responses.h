#pragma once

#include <Eigen/Dense>
#include <array>
#include <atomic>
#include <memory>

#include "bem/model/surface_point.h"

namespace palpa::bem {

/// Responses Xi Φ of a body to single masks, solved without the columns of their nodes: three
/// right-hand sides give the force of a new place, which has many nodes. One thread at a time adds,
/// any number of threads read without locks.
class MaskResponses {
 public:
  struct Response {
    SurfacePoint point{};  ///< of the mask
    double radius = 0;     ///< mm, of the mask; point and radius make the mask
    /// Unknowns v for a force of 1 N along x, y, z, as sums of the columns of GreensColumns.
    Eigen::Matrix<float, Eigen::Dynamic, 3> unknowns;
    /// True if a better one will follow (ReferenceProblem::hasRoughSolution()).
    bool isRough = false;
  };

  /// The newest one of exactly this mask; null if there is none. Valid as long as this object.
  const Response* find(const SurfacePoint& point, double radius) const;
  /// Discards the response if there are kMaxCount.
  void add(Response response);
  bool isFull() const { return count_.load(std::memory_order_relaxed) == kMaxCount; }

  /// Kept until the end of the model: readers may use them at any time.
  static constexpr int kMaxCount = 128;

 private:
  std::array<std::unique_ptr<const Response>, kMaxCount> responses_;
  std::atomic<int> count_{0};
};

}  // namespace palpa::bem

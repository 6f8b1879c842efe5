#include "bem/problem/mask_responses.h"

#include <utility>

namespace palpa::bem {

const MaskResponses::Response* MaskResponses::find(const SurfacePoint& point, double radius) const {
  for (int k = count_.load(std::memory_order_acquire) - 1; k >= 0; --k) {
    const Response& known = *responses_[k];
    if (known.point.triangle == point.triangle && known.point.position == point.position &&
        known.radius == radius)
      return &known;
  }
  return nullptr;
}

void MaskResponses::add(Response response) {
  if (isFull()) return;
  const int count = count_.load(std::memory_order_relaxed);
  responses_[count] = std::make_unique<const Response>(std::move(response));
  count_.store(count + 1, std::memory_order_release);
}

}  // namespace palpa::bem

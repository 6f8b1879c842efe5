#include "app/view/layers/ring_dashes.h"

#include <cmath>

namespace palpa::view {

std::vector<std::vector<Eigen::Vector3d>> ringDashes(const std::vector<Eigen::Vector3d>& ring,
                                                     int count, double share) {
  const std::size_t corners = ring.size();
  std::vector<double> reached{0};  // arc length up to each corner, and all around
  for (std::size_t i = 0; i < corners; ++i) {
    reached.push_back(reached.back() + (ring[(i + 1) % corners] - ring[i]).norm());
  }
  const double length = reached.back();
  if (!(length > 0) || !std::isfinite(length)) return {};
  if (share >= 1) {
    std::vector<Eigen::Vector3d> closed = ring;
    closed.push_back(ring.front());
    return {closed};
  }
  std::vector<std::vector<Eigen::Vector3d>> dashes;
  std::size_t segment = 0;
  const auto advanceTo = [&](double s, std::vector<Eigen::Vector3d>* passed) {
    while (segment + 1 < corners && reached[segment + 1] <= s) {
      ++segment;
      if (passed) passed->push_back(ring[segment]);
    }
    const double piece = reached[segment + 1] - reached[segment];
    const double t = piece > 0 ? (s - reached[segment]) / piece : 0;
    return Eigen::Vector3d((1 - t) * ring[segment] + t * ring[(segment + 1) % corners]);
  };
  for (int i = 0; i < count; ++i) {
    std::vector<Eigen::Vector3d>& dash = dashes.emplace_back();
    dash.push_back(advanceTo(length * i / count, nullptr));
    const Eigen::Vector3d end = advanceTo(length * (i + share) / count, &dash);
    dash.push_back(end);
  }
  return dashes;
}

}  // namespace palpa::view

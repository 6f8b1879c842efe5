#include "bem/element/contact_elements.h"

#include <algorithm>

namespace palpa::bem {

using Eigen::Vector3d;

void ContactElements::setAround(int coefficientCount) {
  around_.resize(static_cast<std::size_t>(coefficientCount));
  for (int e = 0; e < count(); ++e)
    for (const int coefficient : elements_[e].coefficients) around_[coefficient].push_back(e);
}

bool ContactElements::reaches(const Side& side, const Vector3d& middle, double radius) {
  const double distance = (side.points[kPieces / 2] - middle).norm();
  if (distance < radius) return true;
  if (distance - side.radius >= radius) return false;
  for (int k = 0; k < kPieces; ++k) {
    const Vector3d along = side.points[k + 1] - side.points[k], from = middle - side.points[k];
    const double length = along.squaredNorm();
    const double t = length > 0 ? std::clamp(from.dot(along) / length, 0.0, 1.0) : 0.0;
    if ((from - t * along).squaredNorm() < radius * radius) return true;
  }
  return false;
}

}  // namespace palpa::bem

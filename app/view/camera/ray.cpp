#include "app/view/camera/ray.h"

#include <Eigen/Geometry>

namespace palpa::view {

std::optional<double> distanceTo(const Ray& ray, const std::vector<Eigen::Vector3d>& positions,
                                 const Triangle& triangle) {
  // T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection (1997): the point is
  // a + u (b - a) + v (c - a) = origin + s direction, solved by Cramer's rule. A tiny slack on
  // the barycentric coordinates lets no ray slip between two triangles.
  constexpr double kSlack = 1e-12;
  const Eigen::Vector3d& a = positions[static_cast<std::size_t>(triangle[0])];
  const Eigen::Vector3d ab = positions[static_cast<std::size_t>(triangle[1])] - a;
  const Eigen::Vector3d ac = positions[static_cast<std::size_t>(triangle[2])] - a;
  const Eigen::Vector3d p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return std::nullopt;
  const Eigen::Vector3d toOrigin = ray.origin - a;
  const double u = toOrigin.dot(p) / determinant;
  if (!(u >= -kSlack && u <= 1 + kSlack)) return std::nullopt;
  const Eigen::Vector3d q = toOrigin.cross(ab);
  const double v = ray.direction.dot(q) / determinant;
  if (!(v >= -kSlack && u + v <= 1 + kSlack)) return std::nullopt;
  const double distance = ac.dot(q) / determinant;
  if (!(distance > 0)) return std::nullopt;
  return distance;
}

std::optional<double> nearestOnLine(const Ray& ray, const Eigen::Vector3d& through,
                                    const Eigen::Vector3d& direction) {
  constexpr double kMinSineSquared = 3e-4;  // of one degree
  const double lengthSquared = direction.squaredNorm();
  const Eigen::Vector3d normal = direction.cross(ray.direction);
  if (!(normal.squaredNorm() > kMinSineSquared * lengthSquared)) return std::nullopt;
  // Both distances are extremal: w = origin - through is a combination of the two directions and
  // their common normal.
  const Eigen::Vector3d w = ray.origin - through;
  const double cosine = direction.dot(ray.direction);
  return (direction.dot(w) - cosine * ray.direction.dot(w)) / (lengthSquared - cosine * cosine);
}

}  // namespace palpa::view

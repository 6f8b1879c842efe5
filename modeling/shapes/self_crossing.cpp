#include <algorithm>

#include "modeling/shapes/profile.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

/// Twice the signed area of the triangle a b c.
double turnOf(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool rangesMeet(double a, double b, double c, double d) {
  return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

/// True if the closed segments a–b and c–d have a common point.
bool segmentsMeet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (!rangesMeet(a.x(), b.x(), c.x(), d.x()) || !rangesMeet(a.y(), b.y(), c.y(), d.y()))
    return false;
  const double c1 = turnOf(a, b, c), d1 = turnOf(a, b, d);
  const double a1 = turnOf(c, d, a), b1 = turnOf(c, d, b);
  const auto opposite = [](double x, double y) {
    return !(x > 0.0 && y > 0.0) && !(x < 0.0 && y < 0.0);
  };
  return opposite(c1, d1) && opposite(a1, b1);
}

}  // namespace

std::optional<std::array<int, 2>> selfCrossing(const std::vector<Vector2d>& line, bool closed) {
  const int segments = static_cast<int>(line.size()) - 1;
  for (int i = 0; i < segments; ++i)
    for (int j = i + 2; j < segments; ++j) {
      if (closed && i == 0 && j == segments - 1) continue;
      if (segmentsMeet(line[i], line[i + 1], line[j], line[j + 1])) return std::array{i, j};
    }
  return std::nullopt;
}

}  // namespace palpa::modeling

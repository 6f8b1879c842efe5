#include <Eigen/Geometry>
#include <algorithm>

#include "modeling/shapes/profile_cuts.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

/// Fraction of the side's length at each cut.
std::vector<double> lengthFractions(const Profile& profile, const std::vector<double>& cuts) {
  std::vector<double> result;
  const double start = profile.lengthUpTo(cuts.front());
  const double whole = profile.lengthUpTo(cuts.back()) - start;
  for (double cut : cuts) result.push_back((profile.lengthUpTo(cut) - start) / whole);
  return result;
}

}  // namespace

FlatCap::FlatCap(const Profile& profile, const ProfileCuts& cuts) : profile_(profile), cuts_(cuts) {
  for (int direction = 0; direction < 2; ++direction) {
    // Sides 0 and 2 run in opposite directions, as do sides 1 and 3.
    const std::vector<double> near = lengthFractions(profile, cuts.side[direction]);
    const std::vector<double> far = lengthFractions(profile, cuts.side[direction + 2]);
    for (std::size_t i = 0; i < near.size(); ++i)
      fractions_[direction].push_back(0.5 * (near[i] + 1.0 - far[far.size() - 1 - i]));
  }
  for (int k = 0; k < 4; ++k) corners_[k] = profile_.point(cuts_.side[k].front());
}

/// Sides 2 and 3 are reversed, so that x grows with s and t.
Vector2d FlatCap::onSide(int side, int piece, double x) const {
  const std::vector<double>& cuts = cuts_.side[side];
  if (side < 2) return profile_.point(cuts[piece] + x * (cuts[piece + 1] - cuts[piece]));
  const int last = static_cast<int>(cuts.size()) - 1;
  return profile_.point(cuts[last - piece] + x * (cuts[last - piece - 1] - cuts[last - piece]));
}

Vector2d FlatCap::point(int i, int j, double s, double t) const {
  const auto blend = [&](int direction, int piece, double x) {
    const auto& f = fractions_[direction];
    return f[piece] + x * (f[piece + 1] - f[piece]);
  };
  const double a = blend(0, i, s);
  const double b = blend(1, j, t);
  return (1.0 - b) * onSide(0, i, s) + b * onSide(2, i, s) + (1.0 - a) * onSide(3, j, t) +
         a * onSide(1, j, t) - (1.0 - a) * (1.0 - b) * corners_[0] - a * (1.0 - b) * corners_[1] -
         a * b * corners_[2] - (1.0 - a) * b * corners_[3];
}

double FlatCap::quality(int cells, double floor) const {
  double worst = 1.0;
  for (int i = 0; i < pieces(0); ++i)
    for (int j = 0; j < pieces(1); ++j) {
      const int m = std::max(2, cells / pieces(0));
      const int n = std::max(2, cells / pieces(1));
      std::vector<std::vector<Vector2d>> p(m + 1, std::vector<Vector2d>(n + 1));
      for (int k = 0; k <= m; ++k)
        for (int l = 0; l <= n; ++l)
          p[k][l] = point(i, j, static_cast<double>(k) / m, static_cast<double>(l) / n);
      for (int k = 0; k < m; ++k)
        for (int l = 0; l < n; ++l) {
          const Vector2d along = p[k + 1][l + 1] + p[k + 1][l] - p[k][l + 1] - p[k][l];
          const Vector2d across = p[k + 1][l + 1] + p[k][l + 1] - p[k + 1][l] - p[k][l];
          const double area = along.x() * across.y() - along.y() * across.x();
          const double scale = along.norm() * across.norm();
          worst = std::min(worst, scale > 0.0 ? area / scale : 0.0);
        }
      if (worst <= floor) return worst;
    }
  return worst;
}

}  // namespace palpa::modeling

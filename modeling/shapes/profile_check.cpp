#include "modeling/shapes/profile_check.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/shapes/profile.h"
#include "modeling/shapes/shape_parameters.h"

namespace palpa::modeling {
namespace {

void checkProfilePoints(const ProfileCurve& curve, const std::string& path) {
  const std::size_t count = curve.points.size();
  const std::size_t fewest = static_cast<std::size_t>(curve.degree) + 1;
  if (count < fewest || count > Profile::kMaxPoints)
    throw ModelingError(path + ".points_mm: " + std::to_string(count) + " points; degree " +
                        std::to_string(curve.degree) + " needs " + std::to_string(fewest) + " … " +
                        std::to_string(Profile::kMaxPoints));
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const double value = curve.points[i][axis];
      if (std::isfinite(value) && std::abs(value) <= kMaxLength) continue;
      throw ModelingError(path + ".points_mm[" + std::to_string(i) + "][" + std::to_string(axis) +
                          "]: " + numberText(value) + " is not a finite number within ±" +
                          numberText(kMaxLength) + " mm");
    }
}

void checkProfileKnots(const ProfileCurve& curve, const std::string& path) {
  const std::vector<double>& knots = curve.knots;
  const std::size_t order = static_cast<std::size_t>(curve.degree) + 1;
  const std::size_t expected = curve.points.size() + order;
  if (knots.size() != expected)
    throw ModelingError(path + ".knots: " + std::to_string(knots.size()) + " knots, but " +
                        std::to_string(curve.points.size()) + " points of degree " +
                        std::to_string(curve.degree) + " need " + std::to_string(expected));
  const auto fail = [&](std::size_t i, const std::string& what) {
    throw ModelingError(path + ".knots[" + std::to_string(i) + "]: " + numberText(knots[i]) + what);
  };
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i]) || std::abs(knots[i]) > kMaxLength)
      fail(i, " is not a finite number within ±" + numberText(kMaxLength));
    if (i > 0 && knots[i] < knots[i - 1])
      fail(i, " is smaller than the knot before it (" + numberText(knots[i - 1]) + ")");
  }
  const std::size_t last = knots.size() - 1;
  const double range = knots[last] - knots[0];
  if (!(range > 0.0)) fail(last, " equals the first knot; the range must not be empty");
  for (std::size_t i = 1; i < order; ++i) {
    if (knots[i] != knots[0] || knots[last - i] != knots[last])
      fail(knots[i] != knots[0] ? i : last - i,
           " must equal the knot at its end: the first and the last " + std::to_string(order) +
               " knots are equal (clamped) for degree " + std::to_string(curve.degree));
  }
  for (std::size_t i = order; i + order < knots.size(); ++i) {
    if (knots[i] == knots[0] || knots[i] == knots[last] || knots[i] == knots[i + 1 - order])
      fail(i, " occurs more often than degree " + std::to_string(curve.degree) + " allows");
    constexpr double kMinSpan = 1e-6;
    const double gap = std::min(knots[i] - knots[i - 1], knots[last] - knots[i]);
    if (knots[i] != knots[i - 1] && gap < kMinSpan * range)
      fail(i, " is less than a millionth of the knot range away from its neighbour");
  }
}

void checkExtent(const ProfileCurve& curve, const std::string& path) {
  double extent = 0.0;
  for (const Eigen::Vector2d& p : curve.points)
    extent = std::max(extent, (p - curve.points.front()).cwiseAbs().maxCoeff());
  if (extent < kMinLength)
    throw ModelingError(path + ".points_mm: all lie within " + numberText(extent) +
                        " mm; a curve needs at least " + numberText(kMinLength) + " mm");
}

}  // namespace

void checkProfileCurve(const ProfileCurve& curve, const std::string& path) {
  if (curve.degree < 1 || curve.degree > 5)
    throw ModelingError(path + ".degree: " + std::to_string(curve.degree) + "; expected 1 … 5");
  checkProfilePoints(curve, path);
  checkProfileKnots(curve, path);
  checkExtent(curve, path);
}

}  // namespace palpa::modeling

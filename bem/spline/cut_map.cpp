#include "bem/spline/cut_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::bem {
namespace {

CutMap::Values polynomial(const CutMap::Values& values) {
  using Matrix = Eigen::Matrix<double, CutMap::kPoints, CutMap::kPoints>;
  static const Eigen::PartialPivLU<Matrix> interpolate = [] {
    Matrix powers;
    for (int k = 0; k < CutMap::kPoints; ++k)
      for (int m = 0; m < CutMap::kPoints; ++m) powers(k, m) = std::pow(CutMap::node(k), m);
    return powers.partialPivLu();
  }();
  CutMap::Values result{};
  Eigen::Map<Eigen::VectorXd>(result.data(), CutMap::kPoints) =
      interpolate.solve(Eigen::Map<const Eigen::Vector<double, CutMap::kPoints>>(values.data()));
  return result;
}

}  // namespace

double CutMap::node(int k) {
  return -std::cos(std::numbers::pi * k / (kPoints - 1));
}

CutMap::CutMap(int axis, double begin, double end, const Values& lower, const Values& upper,
               Root root)
    : axis_(axis),
      root_(root),
      begin_(begin),
      end_(end),
      lower_(polynomial(lower)),
      upper_(polynomial(upper)) {}

CutMap CutMap::withRoot(Root root) const {
  CutMap map = *this;
  map.root_ = root;
  return map;
}

CutMap::Value CutMap::evaluate(const Values& polynomial, double x) {
  Value result{polynomial[kPoints - 1], 0};
  for (int m = kPoints - 2; m >= 0; --m) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + polynomial[m];
  }
  return result;
}

CutMap::Image CutMap::at(double s, double t) const {
  // `along` runs along the interval, `across` between the graphs.
  const double along = axis_ == 0 ? s : t;
  double across = axis_ == 0 ? t : s, stretch = 1;
  if (root_ == Root::kLower) {
    stretch = 2 * across;
    across *= across;
  } else if (root_ == Root::kUpper) {
    stretch = 2 * (1 - across);
    across *= 2 - across;
  }
  const Value low = evaluate(lower_, 2 * along - 1), high = evaluate(upper_, 2 * along - 1);
  const double height = high.value - low.value;
  const double slope = 2 * (low.slope + across * (high.slope - low.slope));
  const double first = begin_ + along * (end_ - begin_), second = low.value + across * height;
  Image image;
  if (axis_ == 0) {
    image.parameters = {first, second};
    image.derivative << end_ - begin_, 0, slope, height * stretch;
  } else {
    image.parameters = {second, first};
    image.derivative << height * stretch, slope, 0, end_ - begin_;
  }
  return image;
}

std::optional<Eigen::Vector2d> CutMap::invert(double u, double v, double slack) const {
  const double along = ((axis_ == 0 ? u : v) - begin_) / (end_ - begin_);
  if (along < -slack || along > 1 + slack) return {};
  const double low = evaluate(lower_, 2 * along - 1).value;
  const double high = evaluate(upper_, 2 * along - 1).value;
  if (!(high > low)) return {};
  double across = ((axis_ == 0 ? v : u) - low) / (high - low);
  if (across < -slack || across > 1 + slack) return {};
  if (root_ == Root::kLower) across = std::sqrt(std::max(across, 0.0));
  if (root_ == Root::kUpper) across = 1 - std::sqrt(std::max(1 - across, 0.0));
  return axis_ == 0 ? Eigen::Vector2d(along, across) : Eigen::Vector2d(across, along);
}

void CutMap::write(const ByteSink& sink) const {
  writeValue(sink, axis_);
  writeValue(sink, root_);
  writeValue(sink, begin_);
  writeValue(sink, end_);
  writeValue(sink, lower_);
  writeValue(sink, upper_);
}

}  // namespace palpa::bem

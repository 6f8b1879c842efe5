#include "bem/spline/border_functions.h"

#include <algorithm>
#include <cmath>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Smallest distance over the width: the weight is no smaller, so that it can be divided by.
constexpr double kNearest = 1e-12;

/// 1 - (1 - t)^4 without cancellation at small t.
double squaredWeight(double t) {
  const double s = 1 - t;
  return t * (1 + s) * (1 + s * s);
}

void writeMatrix(const ByteSink& sink, const MatrixXd& matrix) {
  writeCount(sink, static_cast<std::size_t>(matrix.rows()));
  writeList(sink, std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
}

}  // namespace

double CutBorder::weight(double distance) {
  return distance >= 1 ? 1 : std::sqrt(squaredWeight(std::max(distance, kNearest)));
}

double CutBorder::slope(double distance) {
  return distance >= 1 ? 0 : 2 * std::pow(1 - distance, 3) / weight(distance);
}

int BorderFunctions::otherCount() const {
  Index count = 0;
  for (const Other& other : others) count += other.ofNet.rows();
  return static_cast<int>(count);
}

double BorderFunctions::weight(const Vector3d& x) const {
  if (!isWeighted) return 1;
  if (isSupport) return CutBorder::weight((*borders)[ownBorder].distance(x));
  double product = 1;
  for (const CutBorder& border : *borders) product *= CutBorder::weight(border.distance(x));
  return product;
}

double BorderFunctions::share(const Other& other, const Vector3d& x) const {
  if (others.size() == 1) return 1;
  double sum = 0, mine = 0;
  for (const Other& each : others) {
    const double w = CutBorder::weight((*borders)[each.border].distance(x)), part = (1 - w) / w;
    sum += part;
    if (&each == &other) mine = part;
  }
  return sum > 0 ? mine / sum : 0;
}

double BorderFunctions::fillTable(const Vector3d& x, double* table) const {
  const double w = weight(x);
  if (isSupport || !isWeighted) return w;
  Map<VectorXd> net(table, netCount());
  double* next = table + netCount();
  for (const Other& other : others) {
    Map<VectorXd>(next, other.ofNet.rows()).noalias() =
        ((1 - w) * share(other, x)) * (other.ofNet * net);
    next += other.ofNet.rows();
  }
  net *= w;
  return w;
}

void BorderFunctions::reduce(const double* table, double* values) const {
  Map<VectorXd>(values, ownCount()).noalias() = own * Map<const VectorXd>(table, netCount());
  std::copy_n(table + netCount(), otherCount(), values + ownCount());
}

void BorderFunctions::tractionValues(const Vector3d& x, const double* net, double leastWeight,
                                     double* values) const {
  Map<VectorXd> ofOwn(values, ownCount());
  ofOwn.noalias() = own * Map<const VectorXd>(net, netCount());
  if (isSupport) ofOwn /= std::max(weight(x), leastWeight);
  std::fill_n(values + ownCount(), otherCount(), 0.0);
}

void BorderFunctions::jet(const Vector3d& x, const Vector3d& tangent,
                          const std::vector<double>& net, std::vector<double>& slopes) const {
  constexpr double kMinDistance = 0.01, kStep = 1e-5;
  const Map<const VectorXd> values(net.data(), netCount());
  const VectorXd slope = Map<const VectorXd>(slopes.data(), netCount());
  double w = 1, slopeOfW = 0;  // logarithmic until the end
  if (isWeighted && !isSupport) {
    for (const CutBorder& border : *borders) {
      const double distance = std::max(border.distance(x), kMinDistance);
      const double length = tangent.norm(), step = kStep * border.width / std::max(length, 1e-300);
      const double along =
          (border.distance(x + step * tangent) - border.distance(x - step * tangent)) / (2 * step);
      const double each = CutBorder::weight(distance);
      w *= each;
      slopeOfW += CutBorder::slope(distance) * along / each;
    }
    slopeOfW *= w;
  }
  slopes.resize(static_cast<std::size_t>(count()));
  Map<VectorXd>(slopes.data(), ownCount()) = own * (w * slope + slopeOfW * values);
  double* next = slopes.data() + ownCount();
  for (const Other& other : others) {
    Map<VectorXd>(next, other.ofNet.rows()) =
        share(other, x) * (other.ofNet * ((1 - w) * slope - slopeOfW * values));
    next += other.ofNet.rows();
  }
}

MatrixXd BorderFunctions::displacementsOfTable() const {
  MatrixXd result = MatrixXd::Zero(count(), tableCount());
  result.topLeftCorner(ownCount(), netCount()) = own;
  result.bottomRightCorner(otherCount(), otherCount()).setIdentity();
  return result;
}

MatrixXd BorderFunctions::tractionsOfTable() const {
  MatrixXd result = MatrixXd::Zero(count(), tableCount());
  result.topLeftCorner(ownCount(), netCount()) = own;
  return result;
}

bool BorderFunctions::hasSameFunctions(const BorderFunctions& other) const {
  return isSupport == other.isSupport && isWeighted == other.isWeighted &&
         own.rows() == other.own.rows() && own.cols() == other.own.cols() && own == other.own &&
         ownBorder == other.ownBorder &&
         std::equal(others.begin(), others.end(), other.others.begin(), other.others.end(),
                    [](const Other& a, const Other& b) {
                      return a.border == b.border && a.ofNet.rows() == b.ofNet.rows() &&
                             a.ofNet == b.ofNet;
                    });
}

void BorderFunctions::write(const ByteSink& sink) const {
  writeValue(sink, isSupport);
  writeValue(sink, isWeighted);
  writeMatrix(sink, own);
  writeCount(sink, others.size());
  for (const Other& other : others) {
    writeValue(sink, other.border);
    writeMatrix(sink, other.ofNet);
  }
  writeList(sink, samples);
}

}  // namespace palpa::bem

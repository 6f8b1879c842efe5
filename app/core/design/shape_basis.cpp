#include "app/core/design/shape_basis.h"

#include <map>

#include "modeling/solid/basis.h"

namespace palpa::app {

using Eigen::Vector2d;
using Eigen::Vector3d;

void ShapeBasis::add(const std::vector<modeling::SurfaceParameter>& places,
                     const std::vector<bem::SampledPoint>& points) {
  for (std::size_t q = 0; q < places.size(); ++q) {
    const modeling::SurfaceParameter& at = places[q];
    const modeling::Patch& patch = solid_.patches()[at.patch];
    const auto u = modeling::basisAt(patch.knots[0], patch.degree[0], at.u);
    const auto v = modeling::basisAt(patch.knots[1], patch.degree[1], at.v);
    const std::size_t begin = weights_.size();
    Vector3d du = Vector3d::Zero(), dv = Vector3d::Zero();
    for (int i = 0; i <= patch.degree[0]; ++i)
      for (int j = 0; j <= patch.degree[1]; ++j) {
        const int index = patch.net[u.first + i][v.first + j];
        const Vector3d& p = solid_.controlPoints()[index];
        du += u.derivative[i] * v.value[j] * p;
        dv += u.value[i] * v.derivative[j] * p;
        weights_.push_back({index, u.value[i] * v.value[j], u.derivative[i] * v.value[j],
                            u.value[i] * v.derivative[j]});
      }
    const Eigen::Matrix3d& frame = points[q].frame;
    Eigen::Matrix2d metric;
    metric.col(0) = frame.leftCols<2>().transpose() * du;
    metric.col(1) = frame.leftCols<2>().transpose() * dv;
    const Eigen::Matrix2d slopes = metric.inverse().transpose();
    for (std::size_t k = begin; k < weights_.size(); ++k) {
      const Vector2d along = slopes * Vector2d(weights_[k].first, weights_[k].second);
      weights_[k].first = along[0];
      weights_[k].second = along[1];
    }
    first_.push_back(weights_.size());
    places_.push_back(at);
  }
}

Eigen::Matrix3Xd ShapeBasis::gradient(const bem::ShapeDensity& density) const {
  Eigen::Matrix3Xd gradient =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(solid_.controlPoints().size()));
  for (int q = 0; q < pointCount(); ++q) {
    const Vector3d value = density.value.col(q);
    const Vector3d first = density.slope.col(2 * q), second = density.slope.col(2 * q + 1);
    const bool hasSlope = !first.isZero(0) || !second.isZero(0);
    for (std::size_t k = first_[q]; k < first_[q + 1]; ++k) {
      const Weight& weight = weights_[k];
      gradient.col(weight.controlPoint) += weight.value * value;
      if (hasSlope)
        gradient.col(weight.controlPoint) += weight.first * first + weight.second * second;
    }
  }
  return gradient;
}

bem::BoundaryForm::Motion ShapeBasis::motion(int first, int count) const {
  bem::BoundaryForm::Motion motion;
  std::map<int, Eigen::Index> columnOf;
  for (std::size_t k = first_[first]; k < first_[first + count]; ++k)
    if (columnOf.try_emplace(weights_[k].controlPoint, columnOf.size()).second)
      motion.controlPoints.push_back(weights_[k].controlPoint);
  motion.functions.setZero(3 * static_cast<Eigen::Index>(count),
                           static_cast<Eigen::Index>(columnOf.size()));
  for (int q = 0; q < count; ++q)
    for (std::size_t k = first_[first + q]; k < first_[first + q + 1]; ++k) {
      const Weight& weight = weights_[k];
      motion.functions.col(columnOf[weight.controlPoint]).segment<3>(3 * q) +=
          Vector3d(weight.value, weight.first, weight.second);
    }
  return motion;
}

}  // namespace palpa::app

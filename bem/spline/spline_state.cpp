#include "bem/spline/spline_state.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Sine of the angle between both derivatives below which tangential derivatives are meaningless.
constexpr double kFlattest = 0.05;

Vector3d sum(const std::vector<double>& weights, const std::vector<int>& indices,
             const std::vector<Vector3d>& vectors) {
  Vector3d total = Vector3d::Zero();
  for (std::size_t f = 0; f < weights.size(); ++f) total += weights[f] * vectors[indices[f]];
  return total;
}

}  // namespace

SurfaceTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at) {
  const SplineElement& element = surface.elements()[at.element];
  const Vector2d middle = surface
                              .parameters({at.element, (element.lower[0] + element.upper[0]) / 2,
                                           (element.lower[1] + element.upper[1]) / 2})
                              .parameters;
  const std::vector<int>& net = surface.net(at.element);
  SplineSurface::BasisJet basis;
  Vector3d du, dv, area;
  Vector2d place;
  for (const double inwards : {0.0, 0.01, 0.05, 0.15, 0.5}) {
    place = at.parameters + inwards * (middle - at.parameters);
    surface.evaluateNet(at.element, place, basis);
    du = sum(basis.du, net, surface.controlPoints());
    dv = sum(basis.dv, net, surface.controlPoints());
    area = du.cross(dv);
    if (area.norm() > kFlattest * du.norm() * dv.norm()) break;
  }
  SurfaceTangents tangents;
  tangents.position = sum(basis.values, net, surface.controlPoints());
  if (surface.borderFunctions(at.element)) {
    surface.evaluateBasis(at.element, place, basis);
    surface.evaluateTractionBasis(at.element, place, kMinWeight, tangents.tractionValues);
  }
  tangents.frame.col(0) = du.normalized();
  tangents.frame.col(2) = area.normalized();
  tangents.frame.col(1) = tangents.frame.col(2).cross(tangents.frame.col(0));
  // Along a tangent t the parameters change by the columns of the inverse of (du, dv) in the frame.
  Eigen::Matrix2d metric;
  metric.col(0) = tangents.frame.leftCols<2>().transpose() * du;
  metric.col(1) = tangents.frame.leftCols<2>().transpose() * dv;
  const Eigen::Matrix2d inverse = metric.inverse().transpose();
  tangents.slopes.resize(2, static_cast<Index>(basis.du.size()));
  for (std::size_t f = 0; f < basis.du.size(); ++f)
    tangents.slopes.col(static_cast<Index>(f)) = inverse * Vector2d(basis.du[f], basis.dv[f]);
  tangents.values = std::move(basis.values);
  return tangents;
}

Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                     const std::vector<int>& indices, const Eigen::VectorXd& coefficients) {
  std::vector<double> basis;
  surface.evaluateBasis(at.element, at.parameters, basis);
  return weightedSum(basis, indices, coefficients);
}

Vector3d splineTraction(const SplineSurface& surface, const SplineMesh::Point& at,
                        const std::vector<int>& slots, const Eigen::VectorXd& p) {
  std::vector<double> basis;
  surface.evaluateTractionBasis(at.element, at.parameters, kMinWeight, basis);
  return weightedSum(basis, slots, p);
}

}  // namespace palpa::bem

#include "bem/spline/spline_state.h"

#include "bem/triangle/results.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
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

Vector3d sum(const std::vector<double>& weights, const std::vector<int>& indices,
             const Eigen::VectorXd& coefficients) {
  Vector3d total = Vector3d::Zero();
  for (std::size_t f = 0; f < weights.size(); ++f)
    total += weights[f] * coefficients.segment<3>(3 * static_cast<Index>(indices[f]));
  return total;
}

}  // namespace

SplineTangents splineTangents(const SplineSurface& surface, const SplineMesh::Point& at) {
  const SplineElement& element = surface.elements()[at.element];
  const Vector2d middle = surface
                              .parameters({at.element, (element.lower[0] + element.upper[0]) / 2,
                                           (element.lower[1] + element.upper[1]) / 2})
                              .parameters;
  const std::vector<int>& functions = surface.functions(at.element);
  SplineSurface::BasisJet basis;
  Vector3d du, dv, area;
  for (const double inwards : {0.0, 0.01, 0.05, 0.15, 0.5}) {
    surface.evaluateBasis(at.element, at.parameters + inwards * (middle - at.parameters), basis);
    du = sum(basis.du, functions, surface.controlPoints());
    dv = sum(basis.dv, functions, surface.controlPoints());
    area = du.cross(dv);
    if (area.norm() > kFlattest * du.norm() * dv.norm()) break;
  }
  SplineTangents tangents;
  tangents.position = sum(basis.values, functions, surface.controlPoints());
  tangents.frame.col(0) = du.normalized();
  tangents.frame.col(2) = area.normalized();
  tangents.frame.col(1) = tangents.frame.col(2).cross(tangents.frame.col(0));
  // Along a tangent t the parameters change by the columns of the inverse of (du, dv) in the frame.
  Eigen::Matrix2d metric;
  metric.col(0) = tangents.frame.leftCols<2>().transpose() * du;
  metric.col(1) = tangents.frame.leftCols<2>().transpose() * dv;
  const Eigen::Matrix2d inverse = metric.inverse().transpose();
  tangents.slopes.resize(2, static_cast<Index>(functions.size()));
  for (std::size_t f = 0; f < functions.size(); ++f)
    tangents.slopes.col(static_cast<Index>(f)) = inverse * Vector2d(basis.du[f], basis.dv[f]);
  tangents.values = std::move(basis.values);
  return tangents;
}

Vector3d splineValue(const SplineSurface& surface, const SplineMesh::Point& at,
                     const std::vector<int>& indices, const Eigen::VectorXd& coefficients) {
  std::vector<double> basis;
  surface.evaluateBasis(at.element, at.parameters, basis);
  return sum(basis, indices, coefficients);
}

SplineSurfaceState splineSurfaceState(const SplineSurface& surface,
                                      const SplineTractions& tractions, const SplineMesh::Point& at,
                                      const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                      const Material& material) {
  const SplineTangents tangents = splineTangents(surface, at);
  const std::vector<int>& functions = surface.functions(at.element);
  SplineSurfaceState state;
  state.position = tangents.position;
  state.displacement = sum(tangents.values, functions, u);
  const Vector3d traction = sum(tangents.values, tractions.ofFunction[at.element], p);
  Eigen::Matrix<double, 3, 2> along = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t f = 0; f < functions.size(); ++f)
    along += u.segment<3>(3 * static_cast<Index>(functions[f])) *
             tangents.slopes.col(static_cast<Index>(f)).transpose();
  state.stress = surfaceStress(tangents.frame, along, traction, material);

  // Normal derivatives: p_a = G (u_a,n + u_n,a) and p_n = 2 G [e_nn + nu / (1 - 2 nu) e_kk].
  const double nu = material.poissonRatio, shear = material.shear();
  const Vector3d inFrame = tangents.frame.transpose() * traction;
  Matrix3d local;
  local.leftCols<2>() = tangents.frame.transpose() * along;
  for (int a = 0; a < 2; ++a) local(a, 2) = inFrame[a] / shear - local(2, a);
  local(2, 2) =
      ((1 - 2 * nu) * inFrame[2] / (2 * shear) - nu * (local(0, 0) + local(1, 1))) / (1 - nu);
  state.gradient = tangents.frame * local * tangents.frame.transpose();
  return state;
}

}  // namespace palpa::bem

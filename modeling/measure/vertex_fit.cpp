#include "modeling/measure/vertex_fit.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Eigen_svd.h>
#include <CGAL/Monge_via_jet_fitting.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace palpa::modeling {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d meanOf(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

Matrix3d spread(const std::vector<Vector3d>& points, const Vector3d& mean) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Vector3d& point : points) sum += (point - mean) * (point - mean).transpose();
  return sum;
}

/// Directions of the spread, the smallest first.
Matrix3d axesOf(const Matrix3d& sum) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(sum).eigenvectors();
}

/// Least squares for |p|² = 2 c·p + d in `Size` dimensions: c and the radius √(d + |c|²) (Pratt,
/// Computer Graphics 21 (1987), the linear fit). Exact for points on a sphere or circle.
template <int Size>
std::optional<std::pair<Eigen::Matrix<double, Size, 1>, double>> roundFit(
    const std::vector<Eigen::Matrix<double, Size, 1>>& points) {
  using Row = Eigen::Matrix<double, Size + 1, 1>;
  if (points.size() < Size + 1) return std::nullopt;
  Eigen::Matrix<double, Eigen::Dynamic, Size + 1> system(points.size(), Size + 1);
  Eigen::VectorXd right(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    system.row(row).template head<Size>() = 2 * points[i].transpose();
    system(row, Size) = 1;
    right[row] = points[i].squaredNorm();
  }
  const auto factors = system.colPivHouseholderQr();
  if (factors.rank() < Size + 1) return std::nullopt;
  const Row solution = factors.solve(right);
  const Eigen::Matrix<double, Size, 1> centre = solution.template head<Size>();
  const double squared = solution[Size] + centre.squaredNorm();
  if (!(squared > 0)) return std::nullopt;
  return std::pair{centre, std::sqrt(squared)};
}

/// Circle through the points projected along `axis`; deviations in that plane.
std::optional<RoundFit> fitAlong(const std::vector<Vector3d>& points, const Vector3d& axis) {
  const Vector3d mean = meanOf(points);
  const Vector3d a = axis.unitOrthogonal(), b = axis.cross(a);
  std::vector<Vector2d> flat;
  for (const Vector3d& point : points) flat.emplace_back(a.dot(point - mean), b.dot(point - mean));
  const auto circle = roundFit<2>(flat);
  if (!circle) return std::nullopt;
  RoundFit fit{circle->second, mean + circle->first.x() * a + circle->first.y() * b, axis, 0};
  for (const Vector2d& point : flat)
    fit.deviation = std::max(fit.deviation, std::abs((point - circle->first).norm() - fit.radius));
  return fit;
}

}  // namespace

double flatDeviation(const std::vector<Vector3d>& points) {
  const Vector3d mean = meanOf(points);
  const Vector3d normal = axesOf(spread(points, mean)).col(0);
  double largest = 0;
  for (const Vector3d& point : points)
    largest = std::max(largest, std::abs(normal.dot(point - mean)));
  return largest;
}

std::optional<RoundFit> fitSphere(const std::vector<Vector3d>& points) {
  const Vector3d mean = meanOf(points);
  std::vector<Vector3d> centred;
  for (const Vector3d& point : points) centred.push_back(point - mean);
  const auto sphere = roundFit<3>(centred);
  if (!sphere) return std::nullopt;
  RoundFit fit{sphere->second, mean + sphere->first, Vector3d::Zero(), 0};
  for (const Vector3d& point : centred)
    fit.deviation = std::max(fit.deviation, std::abs((point - sphere->first).norm() - fit.radius));
  return fit;
}

std::optional<RoundFit> fitCylinder(const std::vector<Vector3d>& points,
                                    const std::vector<Vector3d>& normals) {
  if (points.size() < 4 || normals.empty()) return std::nullopt;
  return fitAlong(points, axesOf(spread(normals, Vector3d::Zero())).col(0));
}

std::optional<RoundFit> fitCircle(const std::vector<Vector3d>& points) {
  if (points.size() < 3) return std::nullopt;
  const Vector3d mean = meanOf(points);
  auto fit = fitAlong(points, axesOf(spread(points, mean)).col(0));
  if (!fit) return fit;
  for (const Vector3d& point : points)
    fit->deviation = std::max(fit->deviation, std::abs(fit->axis.dot(point - mean)));
  return fit;
}

std::optional<Vector2d> jetCurvatures(const std::vector<Vector3d>& points, const Vector3d& normal,
                                      int degree) {
  using Kernel = CGAL::Cartesian<double>;
  using Fitting = CGAL::Monge_via_jet_fitting<Kernel, Kernel, CGAL::Eigen_svd>;
  const auto needed = static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);
  if (points.size() < needed) return std::nullopt;
  std::vector<Kernel::Point_3> list;
  for (const Vector3d& point : points) list.emplace_back(point.x(), point.y(), point.z());
  Fitting fitting;
  auto form = fitting(list.begin(), list.end(), static_cast<std::size_t>(degree), 2);
  form.comply_wrt_given_normal({normal.x(), normal.y(), normal.z()});
  // A surface that bends away from its normal has negative curvatures there.
  Vector2d found(-form.principal_curvatures(0), -form.principal_curvatures(1));
  if (!found.allFinite()) return std::nullopt;
  if (std::abs(found[0]) < std::abs(found[1])) std::swap(found[0], found[1]);
  return found;
}

}  // namespace palpa::modeling

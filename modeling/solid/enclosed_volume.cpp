#include <Eigen/Geometry>
#include <math.hxx>
#include <math_Vector.hxx>

#include "modeling/solid/basis.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

struct GaussPoint {
  BasisFunctions basis;
  double weight = 0.0;  // includes half the length of the span
};

/// x · (du × dv) has degree 3p - 1 per direction; n Gauss points are exact up to 2n - 1.
std::vector<GaussPoint> gaussPoints(const Patch& patch, int direction) {
  const std::vector<double>& knots = patch.knots[direction];
  const int degree = patch.degree[direction];
  const int count = (3 * degree + 1) / 2;
  math_Vector points(1, count), weights(1, count);
  math::GaussPoints(count, points);
  math::GaussWeights(count, weights);
  std::vector<GaussPoint> result;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double half = 0.5 * (knots[i] - knots[i - 1]);
    if (half == 0.0) continue;
    for (int k = 1; k <= count; ++k)
      result.push_back(
          {basisAt(knots, degree, knots[i - 1] + half * (1.0 + points(k))), half * weights(k)});
  }
  return result;
}

/// ∫ x · (du × dv) over one patch, mm³. The basis is evaluated once per line of Gauss points, and
/// the net is summed one direction at a time: about 40 multiplications per Gauss point.
double momentOf(const std::vector<Eigen::Vector3d>& points, const Patch& patch) {
  const std::vector<GaussPoint> vPoints = gaussPoints(patch, 1);
  const std::size_t columns = patch.net.front().size();
  std::vector<Eigen::Vector3d> line(columns), lineDu(columns);
  double sum = 0.0;
  for (const GaussPoint& u : gaussPoints(patch, 0)) {
    for (std::size_t j = 0; j < columns; ++j) {
      line[j].setZero();
      lineDu[j].setZero();
      for (int a = 0; a <= patch.degree[0]; ++a) {
        const Eigen::Vector3d& p = points[patch.net[u.basis.first + a][j]];
        line[j] += u.basis.value[a] * p;
        lineDu[j] += u.basis.derivative[a] * p;
      }
    }
    for (const GaussPoint& v : vPoints) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero(), du = x, dv = x;
      for (int b = 0; b <= patch.degree[1]; ++b) {
        x += v.basis.value[b] * line[v.basis.first + b];
        du += v.basis.value[b] * lineDu[v.basis.first + b];
        dv += v.basis.derivative[b] * line[v.basis.first + b];
      }
      sum += u.weight * v.weight * x.dot(du.cross(dv));
    }
  }
  return sum;
}

}  // namespace

double volume(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches) {
  double sum = 0.0;
  for (const Patch& patch : patches) sum += momentOf(points, patch);
  return sum / 3.0;
}

}  // namespace palpa::modeling

#include "modeling/shapes/spline_basis.h"

#include <BSplCLib.hxx>
#include <BSplSLib.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <math_Matrix.hxx>
#include <string>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

constexpr double kSameKnot = 1e-9;

TColStd_Array1OfReal flatKnots(const SplineBasis& basis) {
  TColStd_Array1OfReal array(1, static_cast<int>(basis.knots.size()));
  for (std::size_t i = 0; i < basis.knots.size(); ++i)
    array.SetValue(static_cast<int>(i) + 1, basis.knots[i]);
  return array;
}

/// Limits of the spans, 0 and 1 included.
std::vector<double> breaksOf(const SplineBasis& basis) {
  std::vector<double> breaks = basis.knots;
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

SplineBasis clamped(int degree, const std::vector<double>& inner) {
  SplineBasis basis{degree, std::vector<double>(degree + 1, 0.0)};
  basis.knots.insert(basis.knots.end(), inner.begin(), inner.end());
  basis.knots.insert(basis.knots.end(), degree + 1, 1.0);
  return basis;
}

std::vector<double> innerKnots(const SplineBasis& basis) {
  return {basis.knots.begin() + basis.degree + 1, basis.knots.end() - basis.degree - 1};
}

}  // namespace

int SplineBasis::spanCount() const {
  return static_cast<int>(breaksOf(*this).size()) - 1;
}

SplineBasis uniformBasis(int degree, int count) {
  assert(count > degree);
  const int spans = count - degree;
  SplineBasis basis{degree, std::vector<double>(count + degree + 1)};
  for (int i = 0; i < static_cast<int>(basis.knots.size()); ++i)
    basis.knots[i] = std::clamp(static_cast<double>(i - degree) / spans, 0.0, 1.0);
  return basis;
}

SplineBasis gradedBasis(int degree, int count, double ratio) {
  assert(count > degree && ratio > 0.0 && ratio < 1.0);
  std::vector<double> inner;
  for (int k = count - degree - 1; k > 0; --k) inner.push_back(std::pow(ratio, k));
  return clamped(degree, inner);
}

SplineBasis reversed(const SplineBasis& basis) {
  SplineBasis result = basis;
  std::reverse(result.knots.begin(), result.knots.end());
  for (double& knot : result.knots) knot = 1.0 - knot;
  return result;
}

SplineBasis merged(const SplineBasis& a, const SplineBasis& b) {
  assert(a.degree == b.degree);
  const std::vector<double> first = innerKnots(a);
  const std::vector<double> second = innerKnots(b);
  std::vector<double> inner;
  // Where one basis has a knot with a higher multiplicity, the two values differ by rounding: the
  // first value is used, otherwise the knots would decrease.
  const auto add = [&](double knot) {
    inner.push_back(!inner.empty() && knot - inner.back() < kSameKnot ? inner.back() : knot);
  };
  auto i = first.begin();
  auto j = second.begin();
  while (i != first.end() || j != second.end()) {
    const bool both = i != first.end() && j != second.end() && std::abs(*i - *j) < kSameKnot;
    if (j == second.end() || both || (i != first.end() && *i < *j)) {
      add(*i++);
      if (both) ++j;
    } else {
      add(*j++);
    }
  }
  return clamped(a.degree, inner);
}

SplineBasis refined(SplineBasis basis, int count) {
  while (basis.count() < count) {
    const std::vector<double> breaks = breaksOf(basis);
    std::size_t widest = 1;
    for (std::size_t i = 2; i < breaks.size(); ++i)
      if (breaks[i] - breaks[i - 1] > (1.0 + kSameKnot) * (breaks[widest] - breaks[widest - 1]))
        widest = i;
    const double knot = 0.5 * (breaks[widest - 1] + breaks[widest]);
    basis.knots.insert(std::upper_bound(basis.knots.begin(), basis.knots.end(), knot), knot);
  }
  return basis;
}

Eigen::RowVectorXd basisValues(const SplineBasis& basis, double t) {
  const int order = basis.degree + 1;
  math_Matrix values(1, 1, 1, order);
  int first = 0;
  if (BSplCLib::EvalBsplineBasis(0, order, flatKnots(basis), t, first, values) != 0)
    throw ModelingError("spline basis: OpenCASCADE cannot evaluate it");
  Eigen::RowVectorXd result = Eigen::RowVectorXd::Zero(basis.count());
  for (int k = 0; k < order; ++k) result[first - 1 + k] = values(1, k + 1);
  return result;
}

PointGrid interpolate(const SplineBasis& u, const SplineBasis& v,
                      const std::function<Eigen::Vector3d(double, double)>& point) {
  const int uCount = u.count();
  const int vCount = v.count();
  const TColStd_Array1OfReal uKnots = flatKnots(u);
  const TColStd_Array1OfReal vKnots = flatKnots(v);
  TColStd_Array1OfReal uSites(1, uCount), vSites(1, vCount);
  BSplCLib::BuildSchoenbergPoints(u.degree, uKnots, uSites);
  BSplCLib::BuildSchoenbergPoints(v.degree, vKnots, vSites);

  TColgp_Array2OfPnt poles(1, uCount, 1, vCount);
  for (int i = 1; i <= uCount; ++i)
    for (int j = 1; j <= vCount; ++j) {
      const Eigen::Vector3d p = point(uSites(i), vSites(j));
      poles.SetValue(i, j, gp_Pnt(p.x(), p.y(), p.z()));
    }
  int problem = 0;
  try {
    BSplSLib::Interpolate(u.degree, v.degree, uKnots, vKnots, uSites, vSites, poles, problem);
  } catch (const Standard_Failure& failure) {
    throw ModelingError(std::string("spline interpolation failed: ") + failure.GetMessageString());
  }
  if (problem != 0) throw ModelingError("spline interpolation failed: singular matrix");

  PointGrid grid(uCount, std::vector<Eigen::Vector3d>(vCount));
  for (int i = 0; i < uCount; ++i)
    for (int j = 0; j < vCount; ++j) {
      const gp_Pnt& p = poles.Value(i + 1, j + 1);
      grid[i][j] = {p.X(), p.Y(), p.Z()};
    }
  return grid;
}

}  // namespace palpa::modeling

#include "bem/spline/spline_quadrature.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "bem/lending_pool.h"
#include "bem/parallel.h"
#include "bem/spline/gauss_rule.h"

namespace palpa::bem {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Cells longer than this are divided before the polar rule: beyond, radii vary too much over the
/// angles.
constexpr double kMostAspect = 1.7;
/// Far more halvings than distances of 1e-6 element sizes need.
constexpr int kMostDepth = 40;

std::array<SplineCell, 2> halves(const SplineCell& cell, int direction) {
  std::array<SplineCell, 2> both{cell, cell};
  both[0].upper[direction] = both[1].lower[direction] =
      (cell.lower[direction] + cell.upper[direction]) / 2;
  return both;
}

bool contains(const SplineCell& cell, const SplinePlace& place) {
  const std::array<double, 2> parameter{place.u, place.v};
  for (int d = 0; d < 2; ++d) {
    const double slack = 1e-9 * (cell.upper[d] - cell.lower[d]);
    if (parameter[d] < cell.lower[d] - slack || parameter[d] > cell.upper[d] + slack) return false;
  }
  return true;
}

/// Gauss points on an interval for a function whose nearest poles lie at `center` ± i pi/2: the
/// error falls like rho^-2n with rho of the Bernstein ellipse through them.
int pointsForPoles(double first, double last, double error) {
  const double half = (last - first) / 2;
  const std::complex<double> pole(-(first + last) / 2 / half, std::numbers::pi / 2 / half);
  const std::complex<double> root = std::sqrt(pole * pole - 1.0);
  const double rho = std::max(std::abs(pole + root), std::abs(pole - root));
  return std::clamp(static_cast<int>(std::ceil(-std::log(error) / (2 * std::log(rho)))) + 1, 3,
                    kMostGaussPoints);
}

/// Distance over the radius of a cell from which a tensor rule keeps a relative error. Measured
/// over spheres, cylinders, tori and plates of degree 3 (tests/spline/spline_quadrature_test.cpp):
/// at most 12 rho^-2n near, rho = 0.93 (R + sqrt(R^2 - 1)), and 0.1 3^(3-n) R^(p-2n) farther off,
/// where what the functions of degree p leave over of the rule's 2n - 1 has to carry the kernel.
double ratioFor(int points, int degree, double error) {
  const double rho = std::pow(12 / error, 1.0 / (2 * points)) / 0.93;
  const double left = std::max(2 * points - degree, 1);
  return std::max((rho + 1 / rho) / 2, std::pow(0.1 * std::pow(3.0, 3 - points) / error, 1 / left));
}

/// Of the entries, over the largest of `exact`.
double largestDifference(const std::vector<double>& values, const std::vector<double>& exact) {
  double difference = 0, largest = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    difference = std::max(difference, std::abs(values[k] - exact[k]));
    largest = std::max(largest, std::abs(exact[k]));
  }
  return difference / largest;
}

}  // namespace

SplineQuadrature::SplineQuadrature(const SplineSurface& surface, double tolerance, const Job& job)
    : surface_(surface),
      placement_(surface),
      kernel_(splineKernelForThisProcessor()),
      error_(std::clamp(tolerance, 1e-12, 1e-2)),
      radial_(std::max(3, static_cast<int>(std::lround(-std::log10(error_))))),
      // What is left has an area like the third power of its size, kernels like the first.
      cornerLevels_(2 + static_cast<int>(std::ceil(-std::log2(error_) / 2))) {
  constexpr std::ptrdiff_t kElementsPerTask = 16;
  const std::ptrdiff_t count = surface.elementCount();
  elements_.resize(count);
  LendingPool<Workspace> pool([] { return Workspace{}; });
  parallelFor((count + kElementsPerTask - 1) / kElementsPerTask, job, "", [&](std::ptrdiff_t task) {
    Workspace work = pool.take();
    const std::ptrdiff_t end = std::min(count, (task + 1) * kElementsPerTask);
    for (std::ptrdiff_t e = task * kElementsPerTask; e < end; ++e)
      prepare(static_cast<int>(e), work);
    pool.giveBack(std::move(work));
  });
}

void SplineQuadrature::prepare(int index, Workspace& work) {
  Element& element = elements_[index];
  const SplineCell cell = cellOf(surface_.elements()[index]);
  element.ball = ballAround(index, cell);
  const auto placeRule = [&](int n, SplinePoints& points) {
    work.rule.clear();
    work.rule.addTensor(cell, n);
    placement_.place(index, work.rule, points);
  };
  placeRule(2 * kMost, work.points);
  const std::vector<double> exact = moments(index, work.points);
  const int degree = placement_.degree(index);
  for (int n = kFewest; n <= kMost; ++n) {
    SplinePoints& rule = element.rules[n - kFewest];
    placeRule(n, rule);
    const bool isEnough = n == kMost || largestDifference(moments(index, rule), exact) <= error_;
    element.ratio[n] = isEnough ? ratioFor(n, degree, error_) : INFINITY;
  }
}

std::vector<double> SplineQuadrature::moments(int index, const SplinePoints& points) const {
  const int stride = placement_.stride(index);
  std::vector<double> sums(static_cast<std::size_t>(3) * stride, 0);
  for (int p = 0; p < points.used; ++p)
    for (int c = 0; c < 3; ++c) {
      const double area = points.area[c][p];
      const double* basis = points.basis.data() + static_cast<std::ptrdiff_t>(p) * stride;
      double* sum = sums.data() + static_cast<std::ptrdiff_t>(c) * stride;
      for (int f = 0; f < stride; ++f) sum[f] += basis[f] * area;
    }
  return sums;
}

int SplineQuadrature::pointsFor(const Element& element, double ratio) const {
  for (int n = kFewest; n <= kMost; ++n)
    if (ratio >= element.ratio[n]) return n;
  return 0;
}

SplineQuadrature::Ball SplineQuadrature::ballAround(int element, const SplineCell& cell) const {
  const auto at = [&](double a, double b) {
    return surface_
        .evaluate({element, cell.lower[0] + a * (cell.upper[0] - cell.lower[0]),
                   cell.lower[1] + b * (cell.upper[1] - cell.lower[1])})
        .position;
  };
  Ball ball{at(0.5, 0.5), 0};
  for (const double a : {0.0, 1.0})
    for (const double b : {0.0, 1.0})
      ball.radius = std::max(ball.radius, (at(a, b) - ball.center).norm());
  return ball;
}

std::array<double, 2> SplineQuadrature::lengths(int element, const SplineCell& cell) const {
  const auto at = [&](double a, double b) {
    return surface_
        .evaluate({element, cell.lower[0] + a * (cell.upper[0] - cell.lower[0]),
                   cell.lower[1] + b * (cell.upper[1] - cell.lower[1])})
        .position;
  };
  // The middle lines do not vanish where an edge is collapsed.
  return {(at(1, 0.5) - at(0, 0.5)).norm(), (at(0.5, 1) - at(0.5, 0)).norm()};
}

void SplineQuadrature::addNear(int element, const SplineCell& cell, const Ball& ball,
                               const Vector3d& x, int depth, Workspace& work) const {
  const int count = pointsFor(elements_[element], (x - ball.center).norm() / ball.radius);
  if (count > 0 || depth >= kMostDepth) {
    work.rule.addTensor(cell, count > 0 ? count : kMost);
    return;
  }
  const std::array<double, 2> length = lengths(element, cell);
  const int longer = length[0] >= length[1] ? 0 : 1;
  for (const SplineCell& half : halves(cell, longer)) {
    if (length[longer] > kMostAspect * length[1 - longer]) {
      addNear(element, half, ballAround(element, half), x, depth + 1, work);
      continue;
    }
    for (const SplineCell& quarter : halves(half, 1 - longer))
      addNear(element, quarter, ballAround(element, quarter), x, depth + 1, work);
  }
}

void SplineQuadrature::addSingular(int element, const SplineCell& cell, const Vector3d& x,
                                   const SplinePlace& place, int depth, Workspace& work) const {
  if (!contains(cell, place)) {
    addNear(element, cell, ballAround(element, cell), x, depth, work);
    return;
  }
  if (depth == 0 && isFoldedCorner(cell, place)) {
    addFoldedCorner(cell, place, work);
    return;
  }
  if (metricVaries(cell, place)) {
    if (depth >= cornerLevels_) return;  // what is left is as small as the tolerance
    for (const SplineCell& half : halves(cell, 0))
      for (const SplineCell& quarter : halves(half, 1))
        addSingular(element, quarter, x, place, depth + 1, work);
    return;
  }
  const std::array<double, 2> length = lengths(element, cell);
  const int longer = length[0] >= length[1] ? 0 : 1;
  if (length[longer] <= kMostAspect * length[1 - longer] || depth >= kMostDepth) {
    addPolar(cell, place, work);
    return;
  }
  for (const SplineCell& half : halves(cell, longer))
    addSingular(element, half, x, place, depth + 1, work);
}

bool SplineQuadrature::metricVaries(const SplineCell& cell, const SplinePlace& place) const {
  constexpr double kMostRatio = 4;
  const double here = surface_.evaluate(place).areaVector().norm();
  for (const double u : {cell.lower[0], cell.upper[0]})
    for (const double v : {cell.lower[1], cell.upper[1]}) {
      const double there = surface_.evaluate({place.element, u, v}).areaVector().norm();
      if (there > kMostRatio * here || here > kMostRatio * there) return true;
    }
  return false;
}

bool SplineQuadrature::isFoldedCorner(const SplineCell& cell, const SplinePlace& place) const {
  const std::array<double, 2> parameter{place.u, place.v};
  for (int d = 0; d < 2; ++d) {
    const double size = cell.upper[d] - cell.lower[d];
    if (std::min(parameter[d] - cell.lower[d], cell.upper[d] - parameter[d]) > 1e-9 * size)
      return false;
  }
  const SplineJet jet = surface_.evaluate(place);
  return jet.du.norm() > 0 && jet.dv.norm() > 0 &&
         jet.areaVector().norm() < 0.05 * jet.du.norm() * jet.dv.norm();
}

void SplineQuadrature::addFoldedCorner(const SplineCell& cell, const SplinePlace& place,
                                       Workspace& work) const {
  // Both derivatives lie on one line, pointing apart (a round cap's corner on its rim), so that a
  // ray from the corner into the cell exists along which the surface leaves it only quadratically.
  // In parameters, angles are gathered around that ray, the more the nearer the corner.
  const SplineJet jet = surface_.evaluate(place);
  const std::array<double, 2> size{
      place.u - cell.lower[0] < cell.upper[0] - place.u ? cell.upper[0] - cell.lower[0]
                                                        : cell.lower[0] - cell.upper[0],
      place.v - cell.lower[1] < cell.upper[1] - place.v ? cell.upper[1] - cell.lower[1]
                                                        : cell.lower[1] - cell.upper[1]};
  const std::array<double, 2> length{jet.du.norm() * std::abs(size[0]),
                                     jet.dv.norm() * std::abs(size[1])};
  const GaussRule& radial = gaussRule(radial_);
  for (int first = 0; first < 2; ++first) {  // the triangles on both sides of the diagonal
    const int second = 1 - first;
    const double flat = length[first] / length[second];
    const auto at = [&](double s, double t) {
      std::array<double, 2> offset{};
      offset[first] = s * size[first];
      offset[second] = s * t * size[second];
      return SplinePlace{place.element, place.u + offset[0], place.v + offset[1]};
    };
    for (std::size_t m = 0; m < radial.points.size(); ++m) {
      const double s = radial.points[m];
      const double along = (surface_.evaluate(at(s, flat)).position - jet.position).norm();
      const double height = std::max(along / (s * length[second]), 1e-6);
      const double from = std::asinh(-flat / height), to = std::asinh((1 - flat) / height);
      const int count = pointsForPoles(from, to, error_);
      const GaussRule& angular = gaussRule(count);
      for (int k = 0; k < count; ++k) {
        const double w = from + angular.points[k] * (to - from);
        const SplinePlace point = at(s, flat + height * std::sinh(w));
        work.rule.add(point.u, point.v,
                      std::abs(size[0] * size[1]) * s * radial.weights[m] * angular.weights[k] *
                          (to - from) * height * std::cosh(w));
      }
    }
  }
}

void SplineQuadrature::addPolar(const SplineCell& cell, const SplinePlace& place,
                                Workspace& work) const {
  const auto [position, du, dv] = surface_.evaluate(place);
  const Vector3d axis = du.normalized();
  const Vector3d across = (dv - dv.dot(axis) * axis).normalized();
  const Vector2d columnU(du.dot(axis), 0), columnV(dv.dot(axis), dv.dot(across));

  const Vector2d center(place.u, place.v);
  const std::array<Vector2d, 4> corner{
      Vector2d(cell.lower[0], cell.lower[1]), Vector2d(cell.upper[0], cell.lower[1]),
      Vector2d(cell.upper[0], cell.upper[1]), Vector2d(cell.lower[0], cell.upper[1])};
  const double cellArea = (cell.upper[0] - cell.lower[0]) * (cell.upper[1] - cell.lower[1]);
  for (int side = 0; side < 4; ++side) {
    const Vector2d a = corner[side] - center, b = corner[(side + 1) % 4] - center;
    const double area = a[0] * b[1] - a[1] * b[0];  // twice that of the triangle
    if (area < 1e-9 * cellArea) continue;
    const auto image = [&](const Vector2d& p) { return Vector2d(columnU * p[0] + columnV * p[1]); };
    const Vector2d from = image(a), edge = image(b) - from;
    const double length = edge.norm();
    const double start = from.dot(edge) / length, end = start + length;
    const double height = std::abs(from[0] * edge[1] - from[1] * edge[0]) / length;
    // Along the side at the distance `height`, t = height sinh w: distances are height cosh w, so
    // that no integrand has poles nearer than ± i pi/2.
    const double first = std::asinh(start / height), last = std::asinh(end / height);
    const int count = pointsForPoles(first, last, error_);
    const GaussRule &angular = gaussRule(count), &radial = gaussRule(radial_);
    for (int k = 0; k < count; ++k) {
      const double w = first + angular.points[k] * (last - first);
      const double along = (height * std::sinh(w) - start) / length;
      const double weight =
          area * angular.weights[k] * (last - first) * height * std::cosh(w) / length;
      const Vector2d reach = a + along * (b - a);
      for (int m = 0; m < radial_; ++m) {
        const double s = radial.points[m];
        work.rule.add(place.u + s * reach[0], place.v + s * reach[1],
                      weight * s * radial.weights[m]);
      }
    }
  }
}

const SplinePoints& SplineQuadrature::points(int index, const Vector3d& x,
                                             const SplinePlace* inside, Workspace& work) const {
  const Element& element = elements_[index];
  if (const int count = inside ? 0 : pointsFor(element, ratio(index, x)); count > 0)
    return element.rules[count - kFewest];
  work.rule.clear();
  const SplineCell cell = cellOf(surface_.elements()[index]);
  if (inside)
    addSingular(index, cell, x, *inside, 0, work);
  else
    addNear(index, cell, element.ball, x, 0, work);
  placement_.place(index, work.rule, work.points);
  return work.points;
}

void SplineQuadrature::integrate(int index, const Vector3d& x, const SplinePlace* inside,
                                 Workspace& work) const {
  const int stride = placement_.stride(index);
  work.sums.assign(static_cast<std::size_t>(kKernelSums) * stride, 0);
  const SplinePoints& at = points(index, x, inside, work);
  work.kernels.resize(static_cast<std::size_t>(kKernelSums) * at.count);
  kernel_.sumKernels({x.data(),
                      at.used,
                      at.count,
                      {at.position[0].data(), at.position[1].data(), at.position[2].data()},
                      {at.area[0].data(), at.area[1].data(), at.area[2].data()},
                      at.areaSize.data(),
                      at.basis.data(),
                      stride,
                      work.kernels.data(),
                      work.sums.data()});
}

}  // namespace palpa::bem

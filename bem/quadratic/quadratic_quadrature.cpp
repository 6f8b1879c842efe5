#include "bem/quadratic/quadratic_quadrature.h"

#include <algorithm>
#include <cmath>

#include "bem/base/gauss_rule.h"
#include "bem/base/triangle_rule.h"

namespace palpa::bem {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Quartering ends far below distances of 1e-6 element sizes. In BorderCoordinates, cells at the
/// border are as thin as the square of their length, so their number grows with every level.
constexpr int kMaxDepth = 40, kMaxDepthAtBorder = 20;

/// Points and weights on the triangle (0, 0), (1, 0), (0, 1); the weights sum to 1/2.
ElementRule symmetricRule(std::span<const TrianglePoint> points) {
  ElementRule rule;
  for (const TrianglePoint& q : points) rule.add(q.barycentric[1], q.barycentric[2], q.weight / 2);
  return rule;
}

/// Gauss rule on the square, collapsed to the triangle: exact for degree 2 count - 2.
ElementRule collapsedRule(int count) {
  const GaussRule& gauss = gaussRule(count);
  ElementRule rule;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double s = gauss.points[i], t = gauss.points[j];
      rule.add(s * (1 - t), s * t, gauss.weights[i] * gauss.weights[j] * s);
    }
  return rule;
}

const ElementRule& unitRule(int rule) {
  static const std::array<ElementRule, 4> kRules{symmetricRule(triangleRule7()),
                                                 symmetricRule(triangleRule16()), collapsedRule(6),
                                                 collapsedRule(8)};
  return kRules[rule];
}

/// Smallest distance over the radius of an element at which each rule keeps a relative error.
/// The errors of random flat elements of aspect ratios up to 10 are at most factor R^-power for
/// R >= 1.4 (tests/quadratic/quadratic_quadrature_test.cpp).
std::array<double, 4> ratios(double error) {
  constexpr std::array<double, 4> kFactor{0.12, 0.012, 0.004, 8e-4}, kPower{4, 7, 9, 14};
  std::array<double, 4> ratio{};
  for (int k = 0; k < 4; ++k) ratio[k] = std::max(1.4, std::pow(kFactor[k] / error, 1 / kPower[k]));
  return ratio;
}

/// Share of the tolerance with which rules are selected on elements with BorderCoordinates, whose
/// positions have degree four: measured (tests/quadratic/border_elements_test.cpp).
constexpr double kBorderShare = 0.05;

/// Powers of the size of a cell to which the rules' errors from curvature are proportional: one
/// more than the degree left for the area by the functions.
constexpr std::array<int, 4> kCurvatureOrder{4, 7, 9, 13};

/// ∫ N dΓ of the six functions, where dΓ is the size of the area vector, which is no polynomial on
/// curved elements: a minimum requirement for a rule at any distance.
using Moments = std::array<double, 6>;
Moments moments(const ElementPoints& points) {
  Moments sums{};
  for (int k = 0; k < points.used; ++k)
    for (int f = 0; f < 6; ++f)
      sums[f] +=
          points.basis[static_cast<std::size_t>(k) * points.stride + f] * points.tractionArea()[k];
  return sums;
}

std::array<std::array<Vector2d, 3>, 4> quarters(const std::array<Vector2d, 3>& c) {
  const Vector2d ab = (c[0] + c[1]) / 2, bc = (c[1] + c[2]) / 2, ca = (c[2] + c[0]) / 2;
  return {{{c[0], ab, ca}, {ab, c[1], bc}, {ca, bc, c[2]}, {ab, bc, ca}}};
}

/// Both parts of a triangle, divided at the middle of the edge from corner `edge` to the next.
std::array<std::array<Vector2d, 3>, 2> halves(const std::array<Vector2d, 3>& corners, int edge) {
  const Vector2d &a = corners[edge], &b = corners[(edge + 1) % 3], &c = corners[(edge + 2) % 3],
                 middle = (a + b) / 2;
  return {{{a, middle, c}, {middle, b, c}}};
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

bool contains(const std::array<Vector2d, 3>& corners, const ElementPlace& place) {
  const Vector2d at(place.u, place.v);
  const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
  for (int k = 0; k < 3; ++k)
    if (cross(corners[(k + 1) % 3] - corners[k], at - corners[k]) < -1e-9 * area) return false;
  return true;
}

}  // namespace

QuadraticQuadrature::QuadraticQuadrature(const QuadraticSurface& surface, double tolerance)
    : surface_(surface),
      loops_(kelvinSumLoopsForThisProcessor()),
      kernel_(quadraticKernelForThisProcessor()),
      accuracy_(0.1 * tolerance),
      tolerance_(std::clamp(tolerance, 1e-12, 1e-2)),
      ratio_(ratios(tolerance_)),
      borderRatio_(ratios(kBorderShare * tolerance_)) {
  elements_.resize(static_cast<std::size_t>(surface.elementCount()));
  for (int e = 0; e < surface.elementCount(); ++e) {
    Element& element = elements_[e];
    element.whole = cellIn(e, {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1)});
    ElementRule rule;
    ElementPoints fine;
    for (const Corners& quarter : quarters(element.whole.corners))
      addRule(quarter, kKeptRules - 1, rule);
    place(e, rule, fine);
    const Moments exact = moments(fine);
    const double largest = *std::max_element(exact.begin(), exact.end());
    for (int k = 0; k < kKeptRules; ++k) {
      rule = unitRule(k);
      place(e, rule, element.rules[k]);
      const Moments found = moments(element.rules[k]);
      for (int f = 0; f < 6; ++f)
        element.curvatureError[k] =
            std::max(element.curvatureError[k], std::abs(found[f] - exact[f]) / largest);
    }
  }
}

std::unique_ptr<ElementQuadrature::Workspace> QuadraticQuadrature::makeWorkspace() const {
  return std::make_unique<Workspace>();
}

int QuadraticQuadrature::ruleFor(int element, double ratio, int depth) const {
  const auto& error = elements_[element].curvatureError;
  const auto& least = surface_.coordinates(element).isPlain() ? ratio_ : borderRatio_;
  for (int k = 0; k < kKeptRules; ++k)
    if (ratio >= least[k] && std::ldexp(error[k], -kCurvatureOrder[k] * depth) <= tolerance_)
      return k;
  return -1;
}

int QuadraticQuadrature::maxDepth(int element) const {
  return surface_.coordinates(element).isPlain() ? kMaxDepth : kMaxDepthAtBorder;
}

QuadraticQuadrature::Cell QuadraticQuadrature::cellIn(int element, const Corners& corners) const {
  const auto at = [&](const Vector2d& local) {
    return surface_.position({element, local[0], local[1]});
  };
  Cell cell{corners, at((corners[0] + corners[1] + corners[2]) / 3), 0, 0, 0};
  std::array<Vector3d, 3> corner;
  for (int k = 0; k < 3; ++k) {
    corner[k] = at(corners[k]);
    const Vector3d middle = at((corners[k] + corners[(k + 1) % 3]) / 2);
    for (const Vector3d& on : {corner[k], middle})
      cell.radius = std::max(cell.radius, (on - cell.center).norm());
  }
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double length = (corner[(k + 1) % 3] - corner[k]).squaredNorm();
    if (length > longest) {
      longest = length;
      cell.longest = k;
    }
  }
  const double area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
  cell.aspect = longest > 0 ? longest / std::max(area, 1e-12 * longest) : 0;
  return cell;
}

void QuadraticQuadrature::addRule(const Corners& c, int rule, ElementRule& to) const {
  const ElementRule& unit = unitRule(rule);
  const Vector2d ab = c[1] - c[0], ac = c[2] - c[0];
  const double area = cross(ab, ac);
  const std::size_t first = to.u.size(), count = unit.u.size();
  for (auto* list : {&to.u, &to.v, &to.weight}) list->resize(first + count);
  for (std::size_t k = 0; k < count; ++k) {
    to.u[first + k] = c[0][0] + unit.u[k] * ab[0] + unit.v[k] * ac[0];
    to.v[first + k] = c[0][1] + unit.u[k] * ab[1] + unit.v[k] * ac[1];
    to.weight[first + k] = area * unit.weight[k];
  }
}

void QuadraticQuadrature::place(int index, ElementRule& rule, ElementPoints& points) const {
  constexpr int kFunctions = 6;
  points.used = static_cast<int>(rule.u.size());
  points.count = rule.pad();
  points.perDirection = 0;
  points.functions[0] = kFunctions;
  points.functions[1] = 0;
  points.stride = kElementLanes;
  points.geometry.resize(static_cast<std::size_t>(kPointValues) * points.count);
  points.basis.resize(static_cast<std::size_t>(kElementLanes) * points.count);
  kernel_.basis({points.count, rule.u.data(), rule.v.data(), points.basis.data()});
  const double* polynomial = surface_.polynomial(index).data();
  const BorderCoordinates& coordinates = surface_.coordinates(index);
  if (coordinates.isPlain()) {
    kernel_.place({polynomial, points.count, rule.u.data(), rule.v.data(), rule.weight.data(),
                   points.geometry.data()});
    return;
  }
  const auto arrayOf = [&](const std::vector<double>& values) {
    return Eigen::Map<const ArrayXd>(values.data(), points.count);
  };
  BorderCoordinates::Mapped at;
  coordinates.map(arrayOf(rule.u), arrayOf(rule.v), at);
  const ArrayXd weight = arrayOf(rule.weight) * at.determinant;
  kernel_.place(
      {polynomial, points.count, at.u.data(), at.v.data(), weight.data(), points.geometry.data()});
  if (!surface_.hasBorderTractions(index)) return;
  Eigen::Map<Eigen::ArrayXXd> geometry(points.geometry.data(), points.count, kPointValues);
  geometry.col(kPointValues - 1) /= at.root;
}

void QuadraticQuadrature::addNear(int index, const Cell& cell, const Vector3d& x, int depth,
                                  ElementRule& to) const {
  const double ratio = (x - cell.center).norm() / cell.radius;
  const int rule = ruleFor(index, ratio, depth);
  if (rule >= 0 || depth >= maxDepth(index)) {
    addRule(cell.corners, rule >= 0 ? rule : kKeptRules - 1, to);
    return;
  }
  // Quarters of an elongated cell are as elongated: near to a point their number would grow with
  // the aspect ratio.
  constexpr double kElongated = 4;
  const auto& least = surface_.coordinates(index).isPlain() ? ratio_ : borderRatio_;
  if (cell.aspect > kElongated && ratio < least.back()) {
    for (const Corners& half : halves(cell.corners, cell.longest))
      addNear(index, cellIn(index, half), x, depth + 1, to);
    return;
  }
  for (const Corners& quarter : quarters(cell.corners))
    addNear(index, cellIn(index, quarter), x, depth + 1, to);
}

void QuadraticQuadrature::addSingular(int index, const Cell& cell, const Vector3d& x,
                                      const ElementPlace& place, int depth, ElementRule& to) const {
  if (!contains(cell.corners, place)) {
    addNear(index, cell, x, depth, to);
    return;
  }
  constexpr double kMaxAspect = 2.5, kMaxVariation = 1.5;
  const SurfaceJet jet = surface_.evaluate(place);
  const double here = jet.areaVector().norm();
  const bool varies =
      std::any_of(cell.corners.begin(), cell.corners.end(), [&](const Vector2d& corner) {
        const double there = surface_.evaluate({index, corner[0], corner[1]}).areaVector().norm();
        return there > kMaxVariation * here || here > kMaxVariation * there;
      });
  const auto lengthOf = [&](int k) {
    const Vector2d edge = cell.corners[(k + 1) % 3] - cell.corners[k];
    return (edge[0] * jet.du + edge[1] * jet.dv).norm();
  };
  const std::array<double, 3> length{lengthOf(0), lengthOf(1), lengthOf(2)};
  const auto longest =
      static_cast<int>(std::max_element(length.begin(), length.end()) - length.begin());
  const double height =
      here * cross(cell.corners[1] - cell.corners[0], cell.corners[2] - cell.corners[0]) /
      length[longest];
  if (depth >= maxDepth(index) || (!varies && length[longest] <= kMaxAspect * height)) {
    addPolar(jet, {place.u, place.v}, cell.corners, accuracy_, to);
    return;
  }
  if (varies) {
    for (const Corners& quarter : quarters(cell.corners))
      addSingular(index, cellIn(index, quarter), x, place, depth + 1, to);
    return;
  }
  for (const Corners& half : halves(cell.corners, longest))
    addSingular(index, cellIn(index, half), x, place, depth + 1, to);
}

void QuadraticQuadrature::collect(int index, const Vector3d& x, const ElementPlace* inside,
                                  Workspace& work) const {
  work.rule.clear();
  if (inside)
    addSingular(index, elements_[index].whole, x, *inside, 0, work.rule);
  else
    addNear(index, elements_[index].whole, x, 0, work.rule);
  place(index, work.rule, work.points);
}

const ElementPoints& QuadraticQuadrature::points(int index, const Vector3d& x,
                                                 const ElementPlace* inside,
                                                 Workspace& work) const {
  collect(index, x, inside, work);
  return work.points;
}

void QuadraticQuadrature::visitRules(int index, const Vector3d& x, const ElementPlace* inside,
                                     Workspace& work, const Visit& visit) const {
  const int rule = inside ? -1 : keptRule(index, x);
  visit(rule >= 0 ? keptPoints(index, rule) : points(index, x, inside, work));
}

void QuadraticQuadrature::integrate(int index, const Vector3d& x, const ElementPlace* inside,
                                    Workspace& work) const {
  work.sums.assign(surface_.coefficients(index).size(), {});
  const int rule = inside ? -1 : keptRule(index, x);
  const ElementPoints& at = rule >= 0 ? keptPoints(index, rule) : points(index, x, inside, work);
  loops_.sumKernels(at.sumTask(x, work.sums.data()));
  const std::span<const double> factors = surface_.tractionFactors(index);
  for (std::size_t f = 0; f < factors.size(); ++f)
    for (int k = 0; k < kKernelSumsU; ++k) work.sums[f].of[k] *= factors[f];
}

}  // namespace palpa::bem

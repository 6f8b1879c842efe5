#include "bem/spline/spline_placement.h"

#include <algorithm>

#include "bem/base/gauss_rule.h"

namespace palpa::bem {

std::array<SplineCell, 2> SplineCell::halves(int direction) const {
  std::array<SplineCell, 2> both{*this, *this};
  both[0].upper[direction] = both[1].lower[direction] = (lower[direction] + upper[direction]) / 2;
  return both;
}

bool SplineCell::contains(const ElementPlace& place) const {
  const std::array<double, 2> parameter{place.u, place.v};
  for (int d = 0; d < 2; ++d) {
    const double slack = 1e-9 * (upper[d] - lower[d]);
    if (parameter[d] < lower[d] - slack || parameter[d] > upper[d] + slack) return false;
  }
  return true;
}

void addTensor(const SplineCell& cell, int pointsPerDirection, ElementRule& points) {
  const GaussRule& rule = gaussRule(pointsPerDirection);
  const double du = cell.upper[0] - cell.lower[0], dv = cell.upper[1] - cell.lower[1];
  const auto n = static_cast<std::size_t>(pointsPerDirection);
  std::size_t k = points.u.size();
  for (auto* list : {&points.u, &points.v, &points.weight}) list->resize(k + n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i, ++k) {
      points.u[k] = cell.lower[0] + du * rule.points[i];
      points.v[k] = cell.lower[1] + dv * rule.points[j];
      points.weight[k] = du * dv * rule.weights[i] * rule.weights[j];
    }
}

SplinePlacement::SplinePlacement(const SplineSurface& surface)
    : surface_(surface), kernel_(splineKernelForThisProcessor()) {
  elements_.resize(surface.elements().size());
  for (int e = 0; e < surface.elementCount(); ++e) {
    Element& element = elements_[e];
    const SplineElement& shape = surface.elements()[e];
    for (int d = 0; d < 2; ++d)
      element.direction[d] = surface.patches()[shape.patch].basis[d].polynomials(shape.span[d]);
    element.functions = static_cast<int>(surface.net(e).size());
    if (surface.isWeighted(e)) element.functions = surface.borderFunctions(e)->tableCount();
    element.controlPoints.reserve(3 * surface.net(e).size());
    for (const int k : surface.net(e))
      for (int c = 0; c < 3; ++c) element.controlPoints.push_back(surface.controlPoints()[k][c]);
  }
}

int SplinePlacement::degree(int element) const {
  const auto& direction = elements_[element].direction;
  return std::max(direction[0].degree, direction[1].degree);
}

void SplinePlacement::place(int index, ElementRule& rule, ElementPoints& points) const {
  place(index, rule, points, true);
}

void SplinePlacement::place(int index, ElementRule& rule, ElementPoints& points,
                            bool withBasis) const {
  const Element& element = elements_[index];
  if (surface_.isCut(index))
    for (std::size_t k = 0; k < rule.u.size(); ++k) {
      const CutMap::Image image = surface_.parameters({index, rule.u[k], rule.v[k]});
      rule.u[k] = image.parameters[0];
      rule.v[k] = image.parameters[1];
      rule.weight[k] *= image.derivative.determinant();
    }
  points.used = static_cast<int>(rule.u.size());
  points.count = rule.pad();
  points.perDirection = 0;
  points.functions[0] = element.functions;
  points.functions[1] = 0;
  points.stride = stride(index);
  const auto count = static_cast<std::size_t>(points.count);
  points.geometry.resize(kPointValues * count);
  if (withBasis) points.basis.assign(count * static_cast<std::size_t>(stride(index)), 0);
  kernel_.placePoints({{element.direction[0], element.direction[1]},
                       element.controlPoints.data(),
                       points.count,
                       rule.u.data(),
                       rule.v.data(),
                       rule.weight.data(),
                       points.geometry.data(),
                       withBasis ? points.basis.data() : nullptr,
                       stride(index)});
  if (surface_.isWeighted(index)) applyWeights(*surface_.borderFunctions(index), points, withBasis);
}

void SplinePlacement::applyWeights(const BorderFunctions& functions, ElementPoints& points,
                                   bool withBasis) {
  double* tractionArea = points.geometry.data() + static_cast<std::ptrdiff_t>(6) * points.count;
  for (int k = 0; k < points.used; ++k) {
    double* table = points.basis.data() + static_cast<std::ptrdiff_t>(k) * points.stride;
    const Eigen::Vector3d x = points.positionOf(k);
    tractionArea[k] /= withBasis ? functions.fillTable(x, table) : functions.weight(x);
  }
}

void SplinePlacement::placeTensor(int index, const SplineCell& cell, int pointsPerDirection,
                                  ElementRule& rule, ElementPoints& points) const {
  rule.clear();
  addTensor(cell, pointsPerDirection, rule);
  const bool needsTable = surface_.isCut(index) || surface_.isWeighted(index);
  place(index, rule, points, needsTable);
  if (needsTable) return;
  points.perDirection = pointsPerDirection;
  for (int d = 0; d < 2; ++d) points.functions[d] = functionsAlong(index, d);
  const auto& direction = elements_[index].direction;
  const int inU = pointsPerDirection * functionsAlong(index, 0);
  points.basis.resize(inU +
                      static_cast<std::size_t>(pointsPerDirection) * functionsAlong(index, 1));
  kernel_.tabulate({direction[0], rule.u.data(), pointsPerDirection, points.basis.data()});
  double along[kElementLanes];
  for (int j = 0; j < pointsPerDirection; ++j)
    along[j] = rule.v[static_cast<std::size_t>(j) * pointsPerDirection];
  kernel_.tabulate({direction[1], along, pointsPerDirection, points.basis.data() + inU});
}

}  // namespace palpa::bem

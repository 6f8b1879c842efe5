#include "bem/spline/spline_points.h"

#include <algorithm>

#include "bem/spline/gauss_rule.h"

namespace palpa::bem {

void SplineRule::clear() {
  u.clear();
  v.clear();
  weight.clear();
}

void SplineRule::add(double atU, double atV, double ofWeight) {
  u.push_back(atU);
  v.push_back(atV);
  weight.push_back(ofWeight);
}

void SplineRule::addTensor(const SplineCell& cell, int pointsPerDirection) {
  const GaussRule& rule = gaussRule(pointsPerDirection);
  const double du = cell.upper[0] - cell.lower[0], dv = cell.upper[1] - cell.lower[1];
  for (int j = 0; j < pointsPerDirection; ++j)
    for (int i = 0; i < pointsPerDirection; ++i)
      add(cell.lower[0] + du * rule.points[i], cell.lower[1] + dv * rule.points[j],
          du * dv * rule.weights[i] * rule.weights[j]);
}

SplinePlacement::SplinePlacement(const SplineSurface& surface)
    : surface_(surface), kernel_(splineKernelForThisProcessor()) {
  elements_.resize(surface.elements().size());
  for (int e = 0; e < surface.elementCount(); ++e) {
    Element& element = elements_[e];
    const SplineElement& shape = surface.elements()[e];
    for (int d = 0; d < 2; ++d)
      element.direction[d] = surface.patches()[shape.patch].basis[d].polynomials(shape.span[d]);
    element.functions = static_cast<int>(surface.functions(e).size());
    element.controlPoints.reserve(static_cast<std::size_t>(3) * element.functions);
    for (const int k : surface.functions(e))
      for (int c = 0; c < 3; ++c) element.controlPoints.push_back(surface.controlPoints()[k][c]);
  }
}

int SplinePlacement::degree(int element) const {
  const auto& direction = elements_[element].direction;
  return std::max(direction[0].degree, direction[1].degree);
}

void SplinePlacement::place(int index, SplineRule& rule, SplinePoints& points) const {
  const Element& element = elements_[index];
  if (surface_.isCut(index))
    for (std::size_t k = 0; k < rule.u.size(); ++k) {
      const CutMap::Image image = surface_.parameters({index, rule.u[k], rule.v[k]});
      rule.u[k] = image.parameters[0];
      rule.v[k] = image.parameters[1];
      rule.weight[k] *= image.derivative.determinant();
    }
  const auto given = rule.u.size();
  const auto count = static_cast<std::size_t>(roundUpToLanes(static_cast<int>(given)));
  rule.u.resize(count, rule.u.front());
  rule.v.resize(count, rule.v.front());
  rule.weight.resize(count, 0);
  points.used = static_cast<int>(given);
  points.count = static_cast<int>(count);
  for (auto* list : {&points.position, &points.area})
    for (auto& component : *list) component.resize(count);
  points.areaSize.resize(count);
  points.basis.assign(count * static_cast<std::size_t>(stride(index)), 0);
  kernel_.placePoints(
      {{element.direction[0], element.direction[1]},
       element.controlPoints.data(),
       points.count,
       rule.u.data(),
       rule.v.data(),
       rule.weight.data(),
       {points.position[0].data(), points.position[1].data(), points.position[2].data()},
       {points.area[0].data(), points.area[1].data(), points.area[2].data()},
       points.areaSize.data(),
       points.basis.data(),
       stride(index)});
}

}  // namespace palpa::bem

#include <algorithm>

#include "bem/spline/spline_surface.h"

// Values of the functions of a SplineSurface, and its geometry at a place.

namespace palpa::bem {

using Eigen::Vector3d;

namespace {

struct Basis1d {
  std::array<double, kMaxSplineDegree + 1> value{}, derivative{};
};

Basis1d basisAt(const BsplineBasis& basis, int span, double parameter) {
  Basis1d result;
  basis.evaluate(span, parameter, result.value.data(), result.derivative.data());
  return result;
}

}  // namespace

void SplineSurface::evaluateBasis(const ElementPlace& place, std::vector<double>& values) const {
  evaluateBasis(place.element, parameters(place).parameters, values);
}

Vector3d SplineSurface::positionAt(int element, const Eigen::Vector2d& at) const {
  std::vector<double> values;
  evaluateNet(element, at, values);
  return sumOfNet(element, values);
}

Vector3d SplineSurface::sumOfNet(int element, const std::vector<double>& values) const {
  Vector3d position = Vector3d::Zero();
  for (std::size_t f = 0; f < values.size(); ++f)
    position += values[f] * controlPoints_[net(element)[f]];
  return position;
}

void SplineSurface::evaluateBasis(int index, const Eigen::Vector2d& at,
                                  std::vector<double>& values) const {
  evaluateNet(index, at, values);
  const BorderFunctions* beside = borderFunctions(index);
  if (!beside) return;
  std::vector<double> table = values;
  table.resize(static_cast<std::size_t>(beside->tableCount()));
  beside->fillTable(sumOfNet(index, values), table.data());
  values.resize(functions_[index].size());
  beside->reduce(table.data(), values.data());
}

void SplineSurface::evaluateTractionBasis(int index, const Eigen::Vector2d& at, double leastWeight,
                                          std::vector<double>& values) const {
  evaluateNet(index, at, values);
  const BorderFunctions* beside = borderFunctions(index);
  if (!beside) return;
  const std::vector<double> net = values;
  values.resize(functions_[index].size());
  beside->tractionValues(sumOfNet(index, net), net.data(), leastWeight, values.data());
}

void SplineSurface::evaluateShares(const ElementPlace& place, std::vector<double>& shares) const {
  const BorderFunctions* beside = borderFunctions(place.element);
  if (!beside) {
    evaluateBasis(place, shares);
    return;
  }
  std::vector<double> values;
  evaluateNet(place.element, parameters(place).parameters, values);
  const std::vector<int>& list = functions_[place.element];
  const auto own = list.begin() + beside->ownCount();
  shares.assign(list.size(), 0);
  double sum = 0;
  for (std::size_t f = 0; f < values.size(); ++f) {
    const auto found = std::find(list.begin(), own, net(place.element)[f]);
    if (found == own) continue;
    shares[found - list.begin()] += values[f];
    sum += values[f];
  }
  if (sum > 0)
    for (double& share : shares) share /= sum;
  else
    std::fill_n(shares.begin(), beside->ownCount(), 1.0 / beside->ownCount());
}

void SplineSurface::evaluateNet(int index, const Eigen::Vector2d& at,
                                std::vector<double>& values) const {
  const SplineElement& element = elements_[index];
  const auto& [u, v] = patches_[element.patch].basis;
  const Basis1d a = basisAt(u, element.span[0], at[0]), b = basisAt(v, element.span[1], at[1]);
  values.clear();
  for (int j = 0; j <= v.degree(); ++j)
    for (int i = 0; i <= u.degree(); ++i) values.push_back(a.value[i] * b.value[j]);
}

void SplineSurface::evaluateNet(int index, const Eigen::Vector2d& at, BasisJet& jet) const {
  const SplineElement& element = elements_[index];
  const auto& [u, v] = patches_[element.patch].basis;
  const Basis1d a = basisAt(u, element.span[0], at[0]), b = basisAt(v, element.span[1], at[1]);
  for (auto* list : {&jet.values, &jet.du, &jet.dv}) list->clear();
  for (int j = 0; j <= v.degree(); ++j)
    for (int i = 0; i <= u.degree(); ++i) {
      jet.values.push_back(a.value[i] * b.value[j]);
      jet.du.push_back(a.derivative[i] * b.value[j]);
      jet.dv.push_back(a.value[i] * b.derivative[j]);
    }
}

void SplineSurface::evaluateBasis(int index, const Eigen::Vector2d& at, BasisJet& jet) const {
  evaluateNet(index, at, jet);
  if (const BorderFunctions* beside = borderFunctions(index)) {
    Vector3d du = Vector3d::Zero(), dv = Vector3d::Zero();
    for (std::size_t f = 0; f < jet.values.size(); ++f) {
      du += jet.du[f] * controlPoints_[net(index)[f]];
      dv += jet.dv[f] * controlPoints_[net(index)[f]];
    }
    const Vector3d x = positionAt(index, at);
    beside->jet(x, du, jet.values, jet.du);
    beside->jet(x, dv, jet.values, jet.dv);
    evaluateBasis(index, at, jet.values);
  }
}

SurfaceJet SplineSurface::evaluate(const ElementPlace& place) const {
  const SplineElement& element = elements_[place.element];
  const auto& [u, v] = patches_[element.patch].basis;
  const auto [at, derivative] = parameters(place);
  const Basis1d a = basisAt(u, element.span[0], at[0]), b = basisAt(v, element.span[1], at[1]);
  SurfaceJet jet{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  const int* function = net(place.element).data();
  for (int j = 0; j <= v.degree(); ++j)
    for (int i = 0; i <= u.degree(); ++i) {
      const Vector3d& point = controlPoints_[*function++];
      jet.position += a.value[i] * b.value[j] * point;
      jet.du += a.derivative[i] * b.value[j] * point;
      jet.dv += a.value[i] * b.derivative[j] * point;
    }
  if (element.cut >= 0) {
    const Vector3d du = jet.du, dv = jet.dv;
    jet.du = derivative(0, 0) * du + derivative(1, 0) * dv;
    jet.dv = derivative(0, 1) * du + derivative(1, 1) * dv;
  }
  return jet;
}

Vector3d SplineSurface::normal(const ElementPlace& place) const {
  const SplineElement& element = elements_[place.element];
  const double middleU = (element.lower[0] + element.upper[0]) / 2;
  const double middleV = (element.lower[1] + element.upper[1]) / 2;
  for (const double inwards : {0.0, 1e-3, 1e-2}) {
    const SurfaceJet jet = evaluate({place.element, place.u + inwards * (middleU - place.u),
                                     place.v + inwards * (middleV - place.v)});
    const Vector3d area = jet.areaVector();
    if (area.norm() > 1e-9 * jet.du.norm() * jet.dv.norm()) return area.normalized();
  }
  return Vector3d::Zero();
}

}  // namespace palpa::bem

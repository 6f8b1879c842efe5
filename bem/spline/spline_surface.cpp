#include "bem/spline/spline_surface.h"

#include <numeric>
#include <stdexcept>

namespace palpa::bem {

using Eigen::Vector3d;

namespace {

struct Basis1d {
  std::array<double, kMostSplineDegree + 1> value{}, derivative{};
};

Basis1d basisAt(const BsplineBasis& basis, int span, double parameter) {
  Basis1d result;
  basis.evaluate(span, parameter, result.value.data(), result.derivative.data());
  return result;
}

}  // namespace

SplineSurface::SplineSurface(std::vector<Vector3d> controlPoints, std::vector<SplinePatch> patches)
    : controlPoints_(std::move(controlPoints)), patches_(std::move(patches)) {
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const SplinePatch& patch = patches_[p];
    const auto& [u, v] = patch.basis;
    if (patch.net.size() != static_cast<std::size_t>(u.count()) * v.count())
      throw std::invalid_argument("SplineSurface: the net of a patch does not fit its knots");
    for (const int point : patch.net)
      if (point < 0 || point >= coefficientCount())
        throw std::invalid_argument("SplineSurface: a net names a point that does not exist");
    firstElement_.push_back(elementCount());
    for (std::size_t j = 0; j < v.spans().size(); ++j)
      for (std::size_t i = 0; i < u.spans().size(); ++i) {
        const auto &spanU = u.spans()[i], &spanV = v.spans()[j];
        elements_.push_back({static_cast<int>(p),
                             {static_cast<int>(i), static_cast<int>(j)},
                             {spanU.lower, spanV.lower},
                             {spanU.upper, spanV.upper}});
        std::vector<int>& list = functions_.emplace_back();
        for (int b = 0; b <= v.degree(); ++b)
          for (int a = 0; a <= u.degree(); ++a)
            list.push_back(patch.net[spanU.first + a + (spanV.first + b) * u.count()]);
      }
  }
}

double SplineSurface::boundingSize() const {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : controlPoints_) box.extend(p);
  return box.diagonal().norm();
}

int SplineSurface::closedSurfaceCount() const {
  std::vector<int> parent(controlPoints_.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int point) {
    while (parent[point] != point) point = parent[point] = parent[parent[point]];
    return point;
  };
  int count = coefficientCount();
  for (const SplinePatch& patch : patches_)
    for (const int point : patch.net) {
      const int a = root(point), b = root(patch.net.front());
      if (a == b) continue;
      parent[a] = b;
      --count;
    }
  return count;
}

void SplineSurface::evaluateBasis(const SplinePlace& place, std::vector<double>& values) const {
  const SplineElement& element = elements_[place.element];
  const auto& [u, v] = patches_[element.patch].basis;
  const Basis1d a = basisAt(u, element.span[0], place.u), b = basisAt(v, element.span[1], place.v);
  values.clear();
  for (int j = 0; j <= v.degree(); ++j)
    for (int i = 0; i <= u.degree(); ++i) values.push_back(a.value[i] * b.value[j]);
}

SplineJet SplineSurface::evaluate(const SplinePlace& place) const {
  const SplineElement& element = elements_[place.element];
  const auto& [u, v] = patches_[element.patch].basis;
  const Basis1d a = basisAt(u, element.span[0], place.u), b = basisAt(v, element.span[1], place.v);
  SplineJet jet{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  const int* function = functions_[place.element].data();
  for (int j = 0; j <= v.degree(); ++j)
    for (int i = 0; i <= u.degree(); ++i) {
      const Vector3d& point = controlPoints_[*function++];
      jet.position += a.value[i] * b.value[j] * point;
      jet.du += a.derivative[i] * b.value[j] * point;
      jet.dv += a.value[i] * b.derivative[j] * point;
    }
  return jet;
}

Vector3d SplineSurface::normal(const SplinePlace& place) const {
  const SplineElement& element = elements_[place.element];
  const double middleU = (element.lower[0] + element.upper[0]) / 2;
  const double middleV = (element.lower[1] + element.upper[1]) / 2;
  for (const double inwards : {0.0, 1e-3, 1e-2}) {
    const SplineJet jet = evaluate({place.element, place.u + inwards * (middleU - place.u),
                                    place.v + inwards * (middleV - place.v)});
    const Vector3d area = jet.areaVector();
    if (area.norm() > 1e-9 * jet.du.norm() * jet.dv.norm()) return area.normalized();
  }
  return Vector3d::Zero();
}

}  // namespace palpa::bem

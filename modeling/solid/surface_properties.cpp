#include "modeling/solid/surface_properties.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <math.hxx>
#include <math_Vector.hxx>
#include <numeric>

#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {
namespace {

/// Calls visit(point, weight) at the Gauss points of every polynomial span; the weight includes the
/// parameter area of the span.
template <class Visit>
void forGaussPoints(const SurfaceEvaluator& surface, Visit visit) {
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    // x · (du × dv) has degree 3p - 1 per direction; n Gauss points are exact up to 2n - 1.
    const auto gauss = [&](int direction) {
      const int count = (3 * surface.degree(patch, direction) + 1) / 2;
      math_Vector points(1, count), weights(1, count);
      math::GaussPoints(count, points);
      math::GaussWeights(count, weights);
      return std::pair(points, weights);
    };
    const auto [uPoints, uWeights] = gauss(0);
    const auto [vPoints, vWeights] = gauss(1);
    const auto& uSpans = surface.spans(patch, 0);
    const auto& vSpans = surface.spans(patch, 1);
    for (std::size_t i = 1; i < uSpans.size(); ++i)
      for (std::size_t j = 1; j < vSpans.size(); ++j) {
        const double uHalf = 0.5 * (uSpans[i] - uSpans[i - 1]);
        const double vHalf = 0.5 * (vSpans[j] - vSpans[j - 1]);
        for (int a = 1; a <= uPoints.Length(); ++a)
          for (int b = 1; b <= vPoints.Length(); ++b)
            visit(surface.evaluate(patch, uSpans[i - 1] + uHalf * (1.0 + uPoints(a)),
                                   vSpans[j - 1] + vHalf * (1.0 + vPoints(b))),
                  uWeights(a) * vWeights(b) * uHalf * vHalf);
      }
  }
}

}  // namespace

double volume(const SurfaceEvaluator& surface) {
  double sum = 0.0;
  forGaussPoints(surface, [&](const SurfacePoint& p, double weight) {
    sum += weight * p.position.dot(p.du.cross(p.dv));
  });
  return sum / 3.0;
}

double area(const SurfaceEvaluator& surface) {
  double sum = 0.0;
  forGaussPoints(surface, [&](const SurfacePoint& p, double weight) {
    sum += weight * p.du.cross(p.dv).norm();
  });
  return sum;
}

std::array<Eigen::Vector3d, 2> boundingBox(const Solid& solid) {
  if (solid.controlPoints().empty()) return {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d low = solid.controlPoints().front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : solid.controlPoints()) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low, high};
}

std::vector<bool> sharpEdges(const Solid& solid, const SurfaceEvaluator& surface, double angle) {
  // The ends are excluded: the normal may be undefined in a corner.
  constexpr std::array<double, 7> kSamples{0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95};
  std::vector<bool> sharp;
  for (const SolidEdge& edge : solid.edges()) {
    double smallestCosine = 1.0;
    for (double t : kSamples) {
      std::array<Eigen::Vector3d, 2> normals;
      for (int use = 0; use < 2; ++use) {
        const SurfaceParameter at = onEdge(surface, edge, use, t);
        normals[use] = surface.normal(at.patch, at.u, at.v);
      }
      smallestCosine = std::min(smallestCosine, normals[0].dot(normals[1]));
    }
    sharp.push_back(smallestCosine < std::cos(angle));
  }
  return sharp;
}

std::vector<int> smoothingGroups(const Solid& solid, const std::vector<bool>& sharp) {
  std::vector<int> group(solid.patches().size());
  std::iota(group.begin(), group.end(), 0);
  // There are few patches: relabelling all of them at every smooth edge is simple and fast enough.
  for (std::size_t e = 0; e < solid.edges().size(); ++e) {
    if (sharp[e]) continue;
    const int keep = group[solid.edges()[e].uses[0].patch];
    const int drop = group[solid.edges()[e].uses[1].patch];
    for (int& g : group)
      if (g == drop) g = keep;
  }
  std::map<int, int> number;
  for (int& g : group) g = number.emplace(g, static_cast<int>(number.size())).first->second;
  return group;
}

}  // namespace palpa::modeling

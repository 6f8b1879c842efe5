#include "bem/spline/spline_mask_widths.h"

#include <algorithm>
#include <cmath>

#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// Reach of a sample over the width there. With a larger reach, coarse elements widen masks on
/// adjacent fine ones; with a smaller one, kinks remain as narrow waves. Every point has samples in
/// reach: the reach is 0.87 times the length of a cubic element.
constexpr double kReach = 0.5;
constexpr int kSamplesPerDirection = 3;
/// Elements extend beyond the sphere around their outermost samples by less than this part of it.
constexpr double kBeyondSamples = 0.5;

/// Spread of functions on uniform elements of the size at a place, in the direction in which these
/// are longest, mm.
double spreadAt(const SplineSurface& surface, const ElementPlace& place, const SurfaceJet& jet) {
  const SplineElement& element = surface.elements()[place.element];
  Eigen::Matrix<double, 3, 2> along;
  along << jet.du, jet.dv;
  along *= surface.parameters(place).derivative.inverse();
  for (int d = 0; d < 2; ++d) {
    const BsplineBasis& basis = surface.patches()[element.patch].basis[d];
    const auto& span = basis.spans()[element.span[d]];
    along.col(d) *= (span.upper - span.lower) * std::sqrt((basis.degree() + 1) / 12.0);
  }
  const Eigen::Matrix2d square = along.transpose() * along;
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(square).eigenvalues()[1]);
}

}  // namespace

SplineMaskWidths::SplineMaskWidths(const SplineSurface& surface)
    : ofFunctions_(surface.controlPoints().size(), 0.0),
      samples_(surface.elements().size()),
      near_(surface.elements().size()) {
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  std::vector<double> basis, areas(ofFunctions_.size(), 0.0);
  visitSplinePoints(surface, all, kSamplesPerDirection, INFINITY,
                    [&](const ElementPlace& place, const SurfaceJet& jet, double area) {
                      const double width = kMinWidth * spreadAt(surface, place, jet);
                      const double reach = kReach * width;
                      samples_[place.element].list.push_back(
                          {jet.position, 1 / (reach * reach), area / (width * width), width});
                      surface.evaluateNet(place.element, surface.parameters(place).parameters,
                                          basis);
                      for (std::size_t f = 0; f < basis.size(); ++f) {
                        const int j = surface.net(place.element)[f];
                        ofFunctions_[j] += area * basis[f] * width;
                        areas[j] += area * basis[f];
                      }
                    });
  for (std::size_t j = 0; j < areas.size(); ++j) ofFunctions_[j] /= areas[j];
  for (Samples& samples : samples_) {
    for (const Sample& sample : samples.list)
      samples.center += sample.position / static_cast<double>(samples.list.size());
    for (const Sample& sample : samples.list) {
      const double away = (sample.position - samples.center).norm();
      samples.radius = std::max(samples.radius, away);
      samples.reach = std::max(samples.reach, away + kReach * sample.width);
    }
  }
  for (int e = 0; e < surface.elementCount(); ++e)
    for (int other = 0; other < surface.elementCount(); ++other) {
      const double apart = (samples_[e].center - samples_[other].center).norm();
      if (apart < (1 + kBeyondSamples) * samples_[e].radius + samples_[other].reach)
        near_[e].push_back(other);
    }
}

double SplineMaskWidths::at(int element, const Vector3d& x) const {
  double sum = 0, total = 0;
  for (const int e : near_[element]) {
    const Samples& samples = samples_[e];
    if ((samples.center - x).squaredNorm() >= samples.reach * samples.reach) continue;
    for (const Sample& sample : samples.list) {
      const double s = 1 - (sample.position - x).squaredNorm() * sample.inverseSquare;
      if (s <= 0) continue;
      const double weight = sample.weight * s * s;
      total += weight;
      sum += weight * sample.width;
    }
  }
  return sum / total;
}

}  // namespace palpa::bem

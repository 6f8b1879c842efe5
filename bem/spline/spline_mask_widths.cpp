#include "bem/spline/spline_mask_widths.h"

#include <algorithm>
#include <cmath>

#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

/// How far a sample reaches, in the width there: farther, coarse elements widen masks on fine ones
/// beside them; less far, bends remain as narrow waves. No place is without samples, as even where
/// functions are narrowest, in corners of patches, that is more than half the length of an element.
constexpr double kReach = 0.75;
constexpr int kSamplesPerDirection = 3;
/// Elements reach beyond the sphere around their outermost samples by less than this part of it.
constexpr double kBeyondSamples = 0.5;

/// How far each function of a surface spreads along it, mm: the root of the largest eigenvalue of
/// ∫ N_j (x - x_j)(x - x_j)^T dΓ / ∫ N_j dΓ, x_j its mean place. Torn functions have that of the
/// whole.
std::vector<double> functionSpreads(const SplineSurface& surface) {
  const std::size_t count = surface.controlPoints().size();
  std::vector<double> area(count, 0.0);
  std::vector<Vector3d> first(count, Vector3d::Zero());
  std::vector<Eigen::Matrix3d> second(count, Eigen::Matrix3d::Zero());
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  std::vector<double> basis;
  visitSplinePoints(surface, all, kMostSplineDegree, INFINITY,
                    [&](const SplinePlace& place, const SplineJet& jet, double weight) {
                      surface.evaluateBasis(place, basis);
                      for (std::size_t f = 0; f < basis.size(); ++f) {
                        const int j = surface.tornFrom(surface.functions(place.element)[f]);
                        area[j] += weight * basis[f];
                        first[j] += weight * basis[f] * jet.position;
                        second[j] += weight * basis[f] * jet.position * jet.position.transpose();
                      }
                    });
  std::vector<double> spreads(count);
  for (std::size_t k = 0; k < count; ++k) {
    const int j = surface.tornFrom(static_cast<int>(k));
    const Vector3d mean = first[j] / area[j];
    const Eigen::Matrix3d about = second[j] / area[j] - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(about, Eigen::EigenvaluesOnly);
    spreads[k] = std::sqrt(std::max(solver.eigenvalues()[2], 0.0));
  }
  return spreads;
}

}  // namespace

SplineMaskWidths::SplineMaskWidths(const SplineSurface& surface)
    : ofFunctions_(functionSpreads(surface)),
      samples_(surface.elements().size()),
      near_(surface.elements().size()) {
  for (double& width : ofFunctions_) width *= kNarrowest;
  std::vector<int> all;
  for (int e = 0; e < surface.elementCount(); ++e) all.push_back(e);
  std::vector<double> basis;
  visitSplinePoints(
      surface, all, kSamplesPerDirection, INFINITY,
      [&](const SplinePlace& place, const SplineJet& jet, double area) {
        surface.evaluateBasis(place, basis);
        const std::vector<int>& functions = surface.functions(place.element);
        double width = 0;
        for (std::size_t f = 0; f < basis.size(); ++f)
          width += basis[f] * ofFunctions_[functions[f]];
        const double reach = kReach * width;
        samples_[place.element].list.push_back({jet.position, 1 / (reach * reach), area, width});
      });
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
      const double weight = sample.area * s * s;
      total += weight;
      sum += weight * sample.width;
    }
  }
  return sum / total;
}

}  // namespace palpa::bem

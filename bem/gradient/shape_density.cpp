#include "bem/gradient/shape_density.h"

namespace palpa::bem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void addEnergyDensity(const FieldSampler& sampler, const std::vector<SampledState>& a,
                      const std::vector<SampledState>& b, double factor, ShapeDensity& density) {
  for (int q = 0; q < sampler.pointCount(); ++q) {
    const SampledPoint& point = sampler.points()[q];
    // The stress is symmetric, so that σ:ε = σ:∇u.
    const double energy = a[q].stress.cwiseProduct(b[q].gradient).sum();
    density.value.col(q) +=
        factor * point.weight *
        (energy * point.frame.col(2) - a[q].gradient.transpose() * b[q].traction -
         b[q].gradient.transpose() * a[q].traction);
  }
}

// With s = |x - c|²/r² the mask is Φ = b / B, b = (1 - s)², B = ∫ b dΓ. The measure Φ dΓ changes by
// [ḃ + b div V - b Ḃ / B] / B with ḃ = -4 (1 - s) (x - c)·(V(x) - V(c)) / r², and the work of h =
// force·u by ∫ (h - H) (ḃ + b div V) dΓ / B, H = ∫ b h dΓ / B.
Vector3d addMaskDensity(const FieldSampler& sampler, const ContactMask& mask,
                        const Eigen::VectorXd& support, const Vector3d& force,
                        const std::vector<SampledState>& states, double factor,
                        ShapeDensity& density) {
  const double inverse = 1 / (mask.radius * mask.radius);
  const Vector3d& centre = mask.point.position;
  const auto height = [&](int q) {
    if (support[q] == 0) return 0.0;
    return std::max(0.0, 1 - (sampler.points()[q].position - centre).squaredNorm() * inverse);
  };
  double total = 0, mean = 0;
  for (int q = 0; q < sampler.pointCount(); ++q)
    if (const double h = height(q); h > 0) {
      total += sampler.points()[q].weight * h * h;
      mean += sampler.points()[q].weight * h * h * force.dot(states[q].displacement);
    }
  mean /= total;
  Vector3d ofCentre = Vector3d::Zero();
  for (int q = 0; q < sampler.pointCount(); ++q) {
    const double h = height(q);
    if (h <= 0) continue;
    const SampledPoint& point = sampler.points()[q];
    const double work = factor * point.weight / total * (force.dot(states[q].displacement) - mean);
    const Vector3d pull = -4 * h * inverse * work * (point.position - centre);
    density.value.col(q) += pull;
    ofCentre -= pull;
    density.slope.middleCols<2>(2 * q) += work * h * h * point.frame.leftCols<2>();
  }
  return ofCentre;
}

}  // namespace palpa::bem

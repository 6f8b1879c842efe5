#include "bem/spline/spline_body_force.h"

#include <algorithm>
#include <limits>

#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

/// Calls visit(place, jet, area vector) at the points of Gauss rules that integrate volume moments
/// of uncut elements exactly, up to the first ones.
template <class Visit>
void visitPoints(const SplineSurface& surface, const Visit& visit) {
  for (int e = 0; e < surface.elementCount(); ++e) {
    const SplinePatch& patch = surface.patches()[surface.elements()[e].patch];
    visitSplinePoints(surface, {e}, std::max(patch.basis[0].degree(), patch.basis[1].degree()) + 4,
                      std::numeric_limits<double>::infinity(),
                      [&](const ElementPlace& place, const SurfaceJet& jet, double area) {
                        visit(place, jet, Vector3d(area * jet.areaVector().normalized()));
                      });
  }
}

}  // namespace

VolumeMoments volumeMoments(const SplineSurface& surface) {
  VolumeMoments moments(surface.controlPoints().front());
  visitPoints(surface, [&](const ElementPlace&, const SurfaceJet& jet, const Vector3d& area) {
    moments.add(jet.position, area);
  });
  return moments;
}

BodyForceWork bodyForceWork(const SplineSurface& surface, const SplineTractions& tractions,
                            const Bulk& bulk) {
  BodyForceWork work;
  if (!bulk.hasBodyForce()) return work;
  const VolumeMoments moments = volumeMoments(surface);
  const Vector3d centre = moments.centroid();
  work.ofDisplacement = Eigen::VectorXd::Zero(3 * static_cast<Index>(surface.coefficientCount()));
  work.ofTraction = Eigen::VectorXd::Zero(3 * static_cast<Index>(tractions.slots.count()));
  work.constant = particularWork(moments, bulk);
  std::vector<double> basis, ofTractions;
  visitPoints(surface, [&](const ElementPlace& place, const SurfaceJet& jet, const Vector3d& area) {
    surface.evaluateBasis(place, basis);
    surface.evaluateTractionBasis(place, ofTractions);
    const double size = area.norm();
    if (!(size > 0)) return;  // the metric is singular
    const ParticularState state = particularState(jet.position - centre, area / size, bulk);
    const std::vector<int>&functions = surface.functions(place.element),
          &slots = tractions.ofFunction[place.element];
    for (std::size_t f = 0; f < basis.size(); ++f) {
      work.ofDisplacement.segment<3>(3 * static_cast<Index>(functions[f])) -=
          size * basis[f] * state.traction;
      work.ofTraction.segment<3>(3 * static_cast<Index>(slots[f])) +=
          size * ofTractions[f] * state.displacement;
    }
  });
  return work;
}

}  // namespace palpa::bem

#include "bem/spline/spline_body_force.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "base/scratch_pool.h"
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
                      [&](const SplinePlace& place, const SplineJet& jet, double area) {
                        visit(place, jet, Vector3d(area * jet.areaVector().normalized()));
                      });
  }
}

}  // namespace

Vector3d SplineBodyForce::at(const SplineCollocationPoint& x,
                             SplineQuadrature::Workspace& work) const {
  if (!bulk_.hasBodyForce()) return Vector3d::Zero();
  const Vector3d& b = bulk_.bodyForce;
  double flux = 0;                       // ∮ e.n
  Vector3d weighted = Vector3d::Zero();  // ∮ e b.n
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const auto inside = std::find_if(x.places.begin(), x.places.end(),
                                     [e](const SplinePlace& p) { return p.element == e; });
    quadrature_.visitRules(e, x.position, inside == x.places.end() ? nullptr : &*inside, work,
                           [&](const SplinePoints& points) {
                             for (int k = 0; k < points.used; ++k) {
                               double r[3], squared = 0, along = 0, load = 0;
                               for (int c = 0; c < 3; ++c) {
                                 r[c] = points.position(c)[k] - x.position[c];
                                 squared += r[c] * r[c];
                                 along += r[c] * points.area(c)[k];
                                 load += b[c] * points.area(c)[k];
                               }
                               const double inverse = 1 / std::sqrt(squared);
                               flux += along * inverse;
                               load *= inverse;
                               for (int c = 0; c < 3; ++c) weighted[c] += load * r[c];
                             }
                           });
  }
  return (flux * b - weighted / (2 * (1 - bulk_.material.poissonRatio))) /
         (8 * std::numbers::pi * bulk_.material.shear());
}

Eigen::VectorXd SplineBodyForce::term(const SplineEquations& equations, const Job& job) const {
  constexpr std::ptrdiff_t kPerTask = 8;
  const auto count = static_cast<std::ptrdiff_t>(equations.points.size());
  Eigen::MatrixX3d atPoints(count, 3);
  ScratchPool<SplineQuadrature::Workspace> pool([] { return SplineQuadrature::Workspace{}; });
  parallelFor((count + kPerTask - 1) / kPerTask, job, [&](std::ptrdiff_t task) {
    SplineQuadrature::Workspace work = pool.take();
    for (std::ptrdiff_t k = task * kPerTask; k < std::min(count, (task + 1) * kPerTask); ++k)
      atPoints.row(k) = at(equations.points[static_cast<std::size_t>(k)], work).transpose();
    pool.giveBack(std::move(work));
  });
  const Eigen::MatrixX3d ofEquations = equations.weights * atPoints;
  return Eigen::Map<const Eigen::VectorXd>(ofEquations.data(), ofEquations.size());
}

VolumeMoments volumeMoments(const SplineSurface& surface) {
  VolumeMoments moments(surface.controlPoints().front());
  visitPoints(surface, [&](const SplinePlace&, const SplineJet& jet, const Vector3d& area) {
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
  std::vector<double> basis;
  visitPoints(surface, [&](const SplinePlace& place, const SplineJet& jet, const Vector3d& area) {
    surface.evaluateBasis(place, basis);
    const double size = area.norm();
    if (!(size > 0)) return;  // the metric is singular
    const ParticularState state = particularState(jet.position - centre, area / size, bulk);
    const std::vector<int>&functions = surface.functions(place.element),
          &slots = tractions.ofFunction[place.element];
    for (std::size_t f = 0; f < basis.size(); ++f) {
      work.ofDisplacement.segment<3>(3 * static_cast<Index>(functions[f])) -=
          size * basis[f] * state.traction;
      work.ofTraction.segment<3>(3 * static_cast<Index>(slots[f])) +=
          size * basis[f] * state.displacement;
    }
  });
  return work;
}

}  // namespace palpa::bem

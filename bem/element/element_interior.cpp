#include "bem/element/element_interior.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/element/gather.h"
#include "bem/model/body_force.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::ptrdiff_t kPointsPerTask = 8;

void forRanges(std::ptrdiff_t count, std::ptrdiff_t perTask, const Job& job,
               const std::function<void(std::ptrdiff_t, std::ptrdiff_t)>& work) {
  parallelFor((count + perTask - 1) / perTask, job, [&](std::ptrdiff_t task) {
    work(task * perTask, std::min(count, (task + 1) * perTask));
  });
}

}  // namespace

ElementInterior::ElementInterior(const ElementSurface& surface, const ElementQuadrature& quadrature,
                                 const Bulk& bulk, std::vector<Vector3d> points, const Job& job)
    : InteriorEvaluator(std::move(points)),
      surface_(surface),
      quadrature_(quadrature),
      bulk_(bulk),
      centre_(this->points().empty() ? Vector3d(0, 0, 0) : this->points().front()),
      constants_(bulk.material),
      sum_(sumInteriorForThisProcessor()),
      feet_(this->points().size()) {
  forRanges(static_cast<std::ptrdiff_t>(feet_.size()), kPointsPerTask, job,
            [&](std::ptrdiff_t first, std::ptrdiff_t end) {
              for (std::ptrdiff_t k = first; k < end; ++k) {
                feet_[k] = nearestOnSurface(surface_, quadrature_, this->points()[k]);
              }
            });
  std::size_t next = 0;
  for (int e = 0; e < surface.elementCount(); ++e)
    for (int rule = 0; rule < ElementQuadrature::kKeptRules; ++rule) {
      firstSource_.push_back(next);
      next += static_cast<std::size_t>(quadrature.keptPoints(e, rule).used);
    }
  firstSource_.push_back(next);
}

void ElementInterior::addSources(int element, const ElementPoints& points, const VectorXd& u,
                                 const VectorXd& p, std::size_t first,
                                 InteriorSources& sources) const {
  const Matrix3Xd displacements = surface_.displacementsOfTable(element, u),
                  tractions = surface_.tractionsOfTable(element, p);
  VectorXd basis;
  for (int k = 0; k < points.used; ++k) {
    points.basisAt(k, basis);
    const Vector3d y = points.positionOf(k), area = points.areaOf(k);
    Vector3d displacement = displacements * basis,
             force = points.tractionArea()[k] * (tractions * basis);
    if (bulk_.hasBodyForce()) {
      const ParticularState particular = particularState(y - centre_, area, bulk_);
      displacement -= particular.displacement;
      force -= particular.traction;  // linear in the area vector
    }
    sources.set(first + static_cast<std::size_t>(k), y, area, displacement, force);
  }
}

InteriorState ElementInterior::sumAt(std::size_t point, const VectorXd& u, const VectorXd& p,
                                     const InteriorSources& far, Scratch& scratch) const {
  const Vector3d& x = points()[point];
  const ElementFoot& foot = feet_[point];
  SurfaceState near = surface_.state(foot.place, u, p, bulk_.material);
  // The rest of the field is without a body force.
  InteriorState particular{Vector3d::Zero(), Matrix3d::Zero()};
  if (bulk_.hasBodyForce()) {
    const Vector3d atFoot = near.position - centre_;
    near.displacement -= particularState(atFoot, Vector3d::Zero(), bulk_).displacement;
    near.gradient -= particularGradient(atFoot, bulk_);
    near.stress -= particularStress(atFoot, bulk_);
    particular = {particularState(x - centre_, Vector3d::Zero(), bulk_).displacement,
                  particularStress(x - centre_, bulk_)};
  }
  const Vector3d shift = near.displacement - near.gradient * near.position;
  const Vector3d linearAtX = shift + near.gradient * x;
  if (foot.distance <= 1e-9 * surface_.boundingSize())
    return {linearAtX + particular.displacement, near.stress + particular.stress};

  LinearState linear;
  for (int i = 0; i < 3; ++i) {
    linear.shift[i] = shift[i];
    for (int k = 0; k < 3; ++k) {
      linear.gradient[i][k] = near.gradient(i, k);
      linear.stress[i][k] = near.stress(i, k);
    }
  }
  InteriorSums sums;
  const auto add = [&](const InteriorSources& sources, std::size_t first, std::size_t count) {
    sum_(sources.task(constants_, first, count, linear, x, sums.displacement.data(),
                      sums.stress.data()));
  };
  for (int e = 0; e < surface_.elementCount(); ++e) {
    const int rule = quadrature_.keptRule(e, x);
    if (rule >= 0) {
      const std::size_t at = static_cast<std::size_t>(e) * ElementQuadrature::kKeptRules +
                             static_cast<std::size_t>(rule);
      add(far, firstSource_[at], firstSource_[at + 1] - firstSource_[at]);
      continue;
    }
    const ElementPoints& points = quadrature_.points(e, x, nullptr, *scratch.quadrature);
    scratch.near.reserve(static_cast<std::size_t>(points.used));
    addSources(e, points, u, p, 0, scratch.near);
    add(scratch.near, 0, static_cast<std::size_t>(points.used));
  }
  InteriorState state = sums.state();
  state.displacement += linearAtX + particular.displacement;
  state.stress += near.stress + particular.stress;
  return state;
}

std::vector<InteriorState> ElementInterior::evaluateAll(const VectorXd& u, const VectorXd& p,
                                                        const Job& job) const {
  InteriorSources far;
  far.resize(firstSource_.back());
  constexpr std::ptrdiff_t kElementsPerTask = 16;
  forRanges(surface_.elementCount(), kElementsPerTask, job,
            [&](std::ptrdiff_t first, std::ptrdiff_t end) {
              for (std::ptrdiff_t e = first; e < end; ++e)
                for (int rule = 0; rule < ElementQuadrature::kKeptRules; ++rule)
                  addSources(static_cast<int>(e), quadrature_.keptPoints(static_cast<int>(e), rule),
                             u, p, firstSource_[e * ElementQuadrature::kKeptRules + rule], far);
            });
  std::vector<InteriorState> states(points().size());
  ScratchPool<Scratch> pool([this] { return Scratch{quadrature_.makeWorkspace(), {}}; });
  forRanges(static_cast<std::ptrdiff_t>(states.size()), kPointsPerTask, job,
            [&](std::ptrdiff_t first, std::ptrdiff_t end) {
              Scratch scratch = pool.take();
              for (std::ptrdiff_t k = first; k < end; ++k)
                states[k] = sumAt(static_cast<std::size_t>(k), u, p, far, scratch);
              pool.giveBack(std::move(scratch));
            });
  return states;
}

}  // namespace palpa::bem

#include "app/core/results/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/core/results/touch.h"
#include "bem/base/error.h"
#include "bem/model/surface_point.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kPresses = 6;
/// Depth of a press over the fingertip's radius; the result does not depend on it, as the body is
/// linear.
constexpr double kDepth = 0.1;
/// Displacements below this part of the body's size count as zero.
constexpr double kStill = 1e-9;

/// The error of one of several fields: the part that the functions can represent, dominated by the
/// soft modes of slender bodies, and the part that varies within elements.
class EstimatedError {
 public:
  /// `carried`: bem::Discretisation::estimatedError() of `fields`.
  EstimatedError(const BoundarySetup& setup, const bem::BoundaryField& fields,
                 const bem::BoundaryField& carried, Eigen::Index column)
      : setup_(setup),
        u_(fields.u.col(column)),
        p_(fields.p.col(column)),
        carried_(carried.u.col(column)) {}

  /// Sums of squares over places.
  struct Sum {
    double error = 0, moved = 0;
    double relative() const { return moved > 0 ? std::sqrt(error / moved) : 0; }
  };
  void add(const bem::SurfacePoint& place, Sum& sum) const {
    const bem::Discretisation& on = *setup_.discretisation;
    sum.error +=
        (on.interpolate(place, carried_) + on.displacementDefect(place, u_, p_, setup_.material))
            .squaredNorm();
    sum.moved += on.interpolate(place, u_).squaredNorm();
  }

 private:
  const BoundarySetup& setup_;
  const Eigen::VectorXd u_, p_, carried_;
};

bem::BoundaryField carriedError(const TouchModel& model, const bem::BoundaryField& fields,
                                const Job& job) {
  const BoundarySetup& setup = model.setup();
  return setup.discretisation->estimatedError(*model.problem(), fields, setup.material, job);
}

/// Relative error at the middle of a contact and four places half-way to its border, over the
/// displacement of the contact; 0 for a contact that does not move.
double errorAtContact(const bem::BoundaryMesh& mesh, const EstimatedError& error,
                      const TouchState::Contact& contact) {
  EstimatedError::Sum sum;
  const double reach = contact.isBall() ? contact.patchRadius() : contact.radius;
  const Vector3d along = contact.normal.unitOrthogonal(), across = contact.normal.cross(along);
  for (const Vector3d& direction :
       std::array<Vector3d, 5>{Vector3d::Zero(), along, -along, across, -across})
    error.add(bem::nearestSurfacePoint(mesh, contact.at + 0.5 * reach * direction), sum);
  const double moved = contact.displacement.norm();
  return moved > kStill * mesh.boundingSize() ? std::sqrt(sum.error / 5) / moved : 0;
}

/// Visits evenly spread triangles: triangles with close numbers are close in space.
template <class Visit>
void spread(const bem::BoundaryMesh& mesh, int samples, const Visit& visit) {
  const int step = std::max(1, mesh.triangleCount() / std::max(samples, 1));
  const Vector3d middle = Vector3d::Constant(1.0 / 3);
  for (int triangle = step / 2; triangle < mesh.triangleCount(); triangle += step)
    visit(bem::SurfacePoint{triangle, middle, mesh.point(triangle, middle), 0.0});
}

}  // namespace

double estimateError(const TouchModel& model, const TouchState& state, const Job& job,
                     int samples) {
  Job quiet = job;
  quiet.progress = nullptr;
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const EstimatedError error(model.setup(), state.field, carriedError(model, state.field, quiet),
                             0);
  EstimatedError::Sum sum;
  spread(mesh, samples, [&](const bem::SurfacePoint& place) {
    job.throwIfCancelled();
    error.add(place, sum);
  });
  double estimate = sum.relative();
  for (const TouchState::Contact& contact : state.contacts)
    estimate = std::max(estimate, errorAtContact(mesh, error, contact));
  return std::max(estimate, state.relativeBalance);
}

double estimateTouchError(const TouchModel& model, const Job& job) {
  const BoundarySetup& setup = model.setup();
  const double radius = defaultTouchRadius(setup.mesh());
  Job quiet = job;
  quiet.progress = nullptr;
  std::vector<TouchState> presses;
  spread(setup.mesh(), kPresses, [&](const bem::SurfacePoint& place) {
    job.throwIfCancelled();
    modeling::Touch press;
    press.name = "press";
    press.at = place.position;
    press.radius = radius;
    press.vector = -kDepth * radius * setup.mesh().normal(place.triangle);
    try {
      presses.push_back(playTouches(model, std::span(&press, 1), 0, quiet));
    } catch (const bem::SolverError&) {
      // The place lies on a support.
    }
  });
  // All at once: the residual of several fields costs little more than the residual of one.
  const auto count = static_cast<Eigen::Index>(presses.size());
  const bem::BoundaryField& rest = model.rest().field;
  bem::BoundaryField fields{Eigen::MatrixXd(rest.u.rows(), count),
                            Eigen::MatrixXd(rest.p.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    // The effect of the press without the loads.
    fields.u.col(k) = presses[static_cast<std::size_t>(k)].field.u - rest.u;
    fields.p.col(k) = presses[static_cast<std::size_t>(k)].field.p - rest.p;
  }
  if (count == 0) return 0;
  const bem::BoundaryField carried = carriedError(model, fields, quiet);
  double largest = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    job.throwIfCancelled();
    largest =
        std::max(largest, errorAtContact(setup.mesh(), EstimatedError(setup, fields, carried, k),
                                         presses[static_cast<std::size_t>(k)].contacts.front()));
  }
  return largest;
}

}  // namespace palpa::app

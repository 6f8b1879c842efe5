#include "app/core/error_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/core/touch.h"
#include "bem/error.h"
#include "bem/surface_point.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kPresses = 6;
/// Of a press, in parts of the fingertip's radius; the body is linear, so any would do.
constexpr double kDepth = 0.1;

/// Mean squares of the defect and of the displacement over some places.
class Defects {
 public:
  Defects(const TouchModel& model, const bem::BoundaryField& field)
      : setup_(model.setup()), u_(field.u.col(0)), p_(field.p.col(0)) {}

  void add(const bem::SurfacePoint& place) {
    const bem::Discretisation& on = *setup_.discretisation;
    defects_ += on.displacementDefect(place, u_, p_, setup_.material).squaredNorm();
    moved_ += on.interpolate(place, u_).squaredNorm();
  }
  double relative() const { return moved_ > 0 ? std::sqrt(defects_ / moved_) : 0.0; }

 private:
  const BoundarySetup& setup_;
  const Eigen::VectorXd u_, p_;
  double defects_ = 0, moved_ = 0;
};

/// The middle of a contact and four places half-way to its border.
double errorAtContact(const TouchModel& model, const TouchState& state,
                      const TouchState::Contact& contact) {
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  Defects defects(model, state.field);
  const double reach = contact.kind == "probe" ? contact.patchRadius() : contact.radius;
  const Vector3d along = contact.normal.unitOrthogonal(), across = contact.normal.cross(along);
  for (const Vector3d& direction :
       std::array<Vector3d, 5>{Vector3d::Zero(), along, -along, across, -across})
    defects.add(bem::nearestSurfacePoint(mesh, contact.at + 0.5 * reach * direction));
  return defects.relative();
}

/// Every so many triangles one. Triangles with close numbers are close in space.
template <class Visit>
void spread(const bem::BoundaryMesh& mesh, int samples, const Visit& visit) {
  const int step = std::max(1, mesh.triangleCount() / std::max(samples, 1));
  const Vector3d middle = Vector3d::Constant(1.0 / 3);
  for (int triangle = step / 2; triangle < mesh.triangleCount(); triangle += step)
    visit(bem::SurfacePoint{triangle, middle, mesh.point(triangle, middle), 0.0});
}

}  // namespace

double estimateError(const TouchModel& model, const TouchState& state, int samples) {
  Defects defects(model, state.field);
  spread(model.setup().mesh(), samples,
         [&](const bem::SurfacePoint& place) { defects.add(place); });
  double estimate = defects.relative();
  for (const TouchState::Contact& contact : state.contacts)
    estimate = std::max(estimate, errorAtContact(model, state, contact));
  return estimate;
}

double estimateTouchError(const TouchModel& model, const bem::Job& job) {
  const BoundarySetup& setup = model.setup();
  const double radius = defaultTouchRadius(setup.mesh());
  bem::Job quiet = job;
  quiet.progress = nullptr;
  double largest = 0;
  spread(setup.mesh(), kPresses, [&](const bem::SurfacePoint& place) {
    job.throwIfCancelled();
    modeling::Touch press;
    press.name = "press";
    press.at = place.position;
    press.radius = radius;
    press.action =
        modeling::TouchDisplacement{-kDepth * radius * setup.mesh().normal(place.triangle)};
    try {
      const TouchState state = playTouches(model, std::span(&press, 1), 0, quiet);
      // What loads alone do is not the press.
      TouchState touched = state;
      touched.field.u -= model.rest().field.u;
      touched.field.p -= model.rest().field.p;
      largest = std::max(largest, errorAtContact(model, touched, touched.contacts.front()));
    } catch (const bem::SolverError&) {
      // A support holds the place.
    }
  });
  return largest;
}

}  // namespace palpa::app

#include "app/core/results/press_error.h"

#include <algorithm>

#include "app/core/results/sampled_error.h"
#include "app/core/results/shape_error.h"
#include "base/box_tree.h"
#include "bem/base/error.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kPresses = 6;
/// Depth of a press over the fingertip's radius; the result does not depend on it, as the body is
/// linear.
constexpr double kDepth = 0.1;

/// Triangles at a distance of more than `radius` from all supports; without such triangles, those
/// outside supports.
std::vector<int> awayFromSupports(const BoundarySetup& setup, double radius) {
  const bem::BoundaryMesh& mesh = setup.mesh();
  const auto middleOf = [&mesh](int triangle) {
    return mesh.point(triangle, Vector3d::Constant(1.0 / 3));
  };
  std::vector<bool> isSupported(static_cast<std::size_t>(mesh.triangleCount()), false);
  std::vector<Vector3d> supported;
  std::vector<BoxTree::Box> boxes;
  for (const BoundarySetup::Part& support : setup.supports)
    for (const int triangle : support.triangles) {
      isSupported[static_cast<std::size_t>(triangle)] = true;
      supported.push_back(middleOf(triangle));
      boxes.emplace_back(supported.back());
    }
  const BoxTree tree(boxes, supported);
  const auto isNear = [&](const Vector3d& place) {
    bool found = false;
    tree.visitNear(place, radius, [&](int each, double reach) {
      found = found ||
              (supported[static_cast<std::size_t>(each)] - place).squaredNorm() < radius * radius;
      return found ? 0.0 : reach;
    });
    return found;
  };
  std::vector<int> away, outside;
  for (int t = 0; t < mesh.triangleCount(); ++t) {
    if (isSupported[static_cast<std::size_t>(t)]) continue;
    outside.push_back(t);
    if (!isNear(middleOf(t))) away.push_back(t);
  }
  return away.empty() ? outside : away;
}

}  // namespace

bool isNearSupport(const BoundarySetup& setup, const Vector3d& place, double radius) {
  const bem::BoundaryMesh& mesh = setup.mesh();
  const auto isNear = [&](int triangle) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(triangle)];
    return std::any_of(corners.begin(), corners.end(), [&](int node) {
      return (mesh.nodes[static_cast<std::size_t>(node)] - place).squaredNorm() < radius * radius;
    });
  };
  return std::any_of(setup.supports.begin(), setup.supports.end(), [&](const auto& support) {
    return std::any_of(support.triangles.begin(), support.triangles.end(), isNear);
  });
}

std::vector<PressError> estimatePressErrors(const TouchModel& model,
                                            std::span<const Vector3d> places, double radius,
                                            const Job& job) {
  const BoundarySetup& setup = model.setup();
  Job quiet = job;
  quiet.progress = nullptr;
  std::vector<TouchState> presses;
  std::vector<PressError> errors(places.size());
  std::vector<std::size_t> pressed;
  for (std::size_t k = 0; k < places.size(); ++k) {
    job.throwIfCancelled();
    modeling::Touch press;
    press.name = "press";
    press.at = places[k];
    press.radius = radius;
    press.vector = -kDepth * radius *
                   setup.mesh().normal(bem::nearestSurfacePoint(setup.mesh(), places[k]).triangle);
    try {
      presses.push_back(playTouches(model, std::span(&press, 1), 0, quiet));
      pressed.push_back(k);
    } catch (const bem::SolverError&) {
      // No place is free.
    }
  }
  // All at once: the residual of several fields costs little more than the residual of one.
  const auto count = static_cast<Eigen::Index>(presses.size());
  const bem::BoundaryField& rest = model.rest().field;
  bem::BoundaryField fields{Eigen::MatrixXd(rest.u.rows(), count),
                            Eigen::MatrixXd(rest.p.rows(), count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    // The effect of the press without the loads and the weight.
    fields.u.col(k) = presses[static_cast<std::size_t>(k)].field.u - rest.u;
    fields.p.col(k) = presses[static_cast<std::size_t>(k)].field.p - rest.p;
  }
  if (count == 0) return errors;
  const double factor = coverFactors(setup).contact;
  const bem::Bulk bulk(setup.material);
  const bem::BoundaryField carried = carriedError(model, bulk, fields, quiet);
  for (Eigen::Index k = 0; k < count; ++k) {
    job.throwIfCancelled();
    const TouchState::Contact& press = presses[static_cast<std::size_t>(k)].contacts.front();
    PressError& error = errors[pressed[static_cast<std::size_t>(k)]];
    error.relative =
        factor * errorAtContact(setup.mesh(), SampledError(setup, bulk, fields, carried, k), press);
    // Splines lie on the body; a page has hundreds of presses.
    if (!setup.splines)
      error.relative += shapeError(model, EnergyDensity(setup, fields.u.col(k), fields.p.col(k)),
                                   press.force.dot(press.deflection) / 2, quiet);
    error.radius = press.radius;
  }
  return errors;
}

TouchError estimateTouchError(const TouchModel& model, const Job& job) {
  const BoundarySetup& setup = model.setup();
  const double radius = defaultTouchRadius(setup.mesh());
  std::vector<Vector3d> places;
  for (const bem::SurfacePoint& place :
       spread(setup.mesh(), awayFromSupports(setup, radius), kPresses))
    places.push_back(place.position);
  TouchError error;
  for (const PressError& press : estimatePressErrors(model, places, radius, job)) {
    error.relative = std::max(error.relative, press.relative);
    error.widening = std::max(error.widening, press.radius / radius);
  }
  return error;
}

}  // namespace palpa::app

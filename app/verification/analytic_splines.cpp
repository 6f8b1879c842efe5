#include "app/verification/analytic_splines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/core/setup/to_spline_surface.h"
#include "app/verification/spline_body.h"
#include "bem/spline/spline_results.h"
#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::verification {
using namespace bem;

namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Held where the tag is 1.
SplineSurface surfaceOf(const AnalyticCase& body) {
  const json& g = body.geometry();
  const std::string& shape = body.shape();
  const auto base = [](const Vector3d& x) { return x.z() < 1e-6; };
  if (shape == "sphere")
    return fixedWhere(app::splineSurfaceOf(modeling::makeSphere(g.at("R"), 9)), isBelow);
  if (shape == "cylinder")
    return fixedWhere(app::splineSurfaceOf(halved(modeling::makeCylinder(g.at("R"), g.at("H")))),
                      base);
  if (shape == "torus")
    return fixedWhere(app::splineSurfaceOf(makeTorus(g.at("R_major"), g.at("r_minor"))),
                      [](const Vector3d& x) { return x.z() < -7; });
  if (shape != "box")
    throw modeling::ModelingError(body.id() + ": there is no solid of a " + shape);
  const Vector3d size = vectorOf(g.at("max")) - vectorOf(g.at("min"));
  return fixedWhere(app::splineSurfaceOf(halved(halved(modeling::makeBox(size)))), base);
}

/// A body under pressure that is incompressible does not move at all: its error is compared with a
/// twentieth of what the load would do to a rod of its size.
double pointError(const AnalyticCase& body, const SplineBody& solved, const ExactField& exact) {
  const SplineResults results(solved.surface, solved.tractions);
  double error = 0, moved = 0, stress = 0, size = 0;
  for (const AnalyticCase::Point& point : body.points()) {
    Vector3d found = Vector3d::Constant(std::numeric_limits<double>::infinity());
    if (!point.isInside) {
      found = solved.displacement(nearestPlace(solved.surface, point.at));
    } else if (const auto state = results.interiorState(
                   solved.field.u.col(0), solved.field.p.col(0), body.bulk(), point.at)) {
      found = state->displacement;
    }
    error = worse(error, (found - point.displacement).norm());
    moved = std::max(moved, point.displacement.norm());
    stress = std::max(stress, exact.stress(point.at).norm());
    size = std::max(size, 2 * point.at.norm());
  }
  return error / std::max(moved, 0.05 * stress / solved.material.youngsModulus * size);
}

}  // namespace

bool hasSolid(const AnalyticCase& body) {
  const auto is = [&](const char* shape) { return body.shape() == shape; };
  return is("sphere") || is("cylinder") || is("torus") || is("box");
}

SplineErrors solveWithSplines(const AnalyticCase& body, const Job& job) {
  const ExactField exact = body.exactField();
  const SplineBody solved(surfaceOf(body), body.material(), exact, {1e-5}, Precision::kDouble, job);
  return {solved.surface.coefficientCount(), pointError(body, solved, exact)};
}

}  // namespace palpa::verification

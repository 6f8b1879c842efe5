#pragma once

#include <functional>
#include <vector>

#include "bem/contact/contact_simulation.h"

/// Hertz's law on a sphere that is fixed at its bottom, for either discretisation.
namespace palpa::bem::test {

constexpr double kHertzRadius = 25;  ///< mm, of the body about the origin
constexpr Material kHertzMaterial{0.1, 0.45};

/// The body for contacts, without loads.
struct HertzBody {
  const ContactSurface& surface;
  GreensColumns& columns;
  const BoundaryField& base;
};

/// Presses rigid balls (25 and 100 mm) on the top of the body until the contact circle should have
/// each of the given radii (mm, ascending). Expects the force of Hertz's law, within `tolerance` as
/// a function of the radius, and its exponent over the depth.
///
/// Two spheres approach by δ under F = 4/3 E* √R δ^1.5 with 1/R the sum of curvatures, over a
/// circle a = √(R δ) (K. L. Johnson, Contact Mechanics, 4.22-4.24; analytic.json has the same), if
/// both are half-spaces at the scale of a. Here the body is a sphere fixed at its bottom: the whole
/// sphere and its support yield by an additional C F, where C is the compliance under a bump as
/// wide as the contact pressure (equal mean of ρ^2: r^2 / 4 = 2 a^2 / 5) minus the compliance of a
/// half-space. The remaining error is of the order (a / R)^2.
void expectHertz(const HertzBody& body, const std::vector<double>& circles,
                 const std::function<double(double)>& tolerance, double exponentTolerance);

/// Presses a rigid ball by each approach (mm) on a flat place with the normal +z of a body that
/// yields as a whole much more than at the contact: a circle narrower than the masks. Expects the
/// force F of approach = a^2 / R + C F with Hertz's F and the compliance C of the body as above.
void expectHertzOnSoftBody(const HertzBody& body, const Eigen::Vector3d& top, double ball,
                           const std::vector<double>& approaches, double tolerance);

}  // namespace palpa::bem::test

#include <cmath>
#include <limits>
#include <numbers>

#include "app/core/setup/spline_refinement.h"
#include "bem/spline/spline_mask_widths.h"

namespace palpa::app {
namespace {

/// Size of the elements over the radius of a bump for an error of 1e-2. Measured on a box of 40 x
/// 40 x 20 mm held at its base, bump of 8 mm on a knot and beside it, nu = 0.3 and 0.48, cubic,
/// even elements (largest of four errors against h/r = 0.28):
///   h/r            1.0   0.83   0.71   0.63    0.50    0.42    0.36
///   u at the top   0.26  0.10   0.10   0.031   9e-3    2.5e-3  3e-3
///   mean u below   0.13  0.04   0.03   0.012   5e-3    1.7e-3  8e-4
/// so the error falls like its sixth power.
constexpr double kOfRadius = 0.54;
/// Narrowest mask at a touch over the requested radius, for an error of 1e-2: masks as narrow as
/// the functions can carry differ slightly from smooth bumps. A press of 6 mm radius on the box's
/// top is 2 % too stiff with 0.97, 0.5 % with 0.88.
constexpr double kOfTouch = 0.95;

}  // namespace

// The rim was measured on a cylinder (R = 20 mm, 60 mm high) pressed between bonded plates, with
// elements of about 4 mm and nu = 0.45: the error of the reaction is 2.1e-3 without grading, 1.3e-3
// with a first element of 0.5, 1.0e-4 with 0.3. At 1e-2, grading only the free side saves a fifth
// of the coefficients; the balance of the gripper finger is off by 1.1 % without grading, by 0.5 %
// with it. The budget limits the time to build a model.
ElementSizes ElementSizes::of(const modeling::MeshSettings& settings, double fingertipRadius) {
  const double wish = settings.accuracy / 1e-2;
  const double density = settings.elementLength ? 1 : settings.splineDensity;
  ElementSizes sizes;
  const double finer = std::pow(wish, 1.0 / 6) / density;
  sizes.touch = kOfTouch * finer;
  sizes.bump = kOfRadius * finer;
  sizes.interior = settings.elementLength.value_or(sizes.touch * fingertipRadius * std::sqrt(3.0) /
                                                   bem::SplineMaskWidths::kMinWidth);
  sizes.turn = settings.elementLength ? std::numbers::pi / 4
                                      : std::numbers::pi / 6 * std::pow(wish, 0.25) / density;
  sizes.rim = std::min(0.5, 0.5 * std::pow(wish, 0.45));
  sizes.isRimOutside = wish >= 1;
  sizes.border = sizes.interior;
  sizes.budget = settings.elementLength ? std::numeric_limits<double>::infinity()
                                        : 1250 * std::pow(wish, -0.35) * density * density;
  if (settings.elementLength) sizes.touch = std::numeric_limits<double>::infinity();
  return sizes;
}

}  // namespace palpa::app

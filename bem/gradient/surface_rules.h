#pragma once

#include <span>
#include <vector>

#include "bem/element/contact_elements.h"
#include "bem/element/element_surface.h"
#include "bem/gradient/field_sampler.h"
#include "bem/gradient/moving_elements.h"
#include "bem/gradient/shape_density.h"
#include "bem/model/displacement_recovery.h"

namespace palpa::bem {

class SplineSurface;
class QuadraticSurface;

/// Points of a rule over curved elements: one block per element, and the place of each point.
struct SampledElements {
  std::vector<FieldSampler::Block> blocks;
  std::vector<ElementPlace> places;
};

/// Tensor Gauss rule of `points` per direction on some elements. `functions`: of the surface.
SampledElements sampledSplines(const SplineSurface& surface, const ElementSurface& functions,
                               const std::vector<int>& elements, int points);
/// The points at which the contact surface integrates bumps, on the elements of some coefficients.
SampledElements sampledBumps(const SplineSurface& surface, const ElementSurface& functions,
                             const ContactElements& contact, std::span<const int> coefficients);
SampledElements sampledBumps(const QuadraticSurface& surface, const ContactElements& contact,
                             std::span<const int> coefficients);
/// Rule of degree 8 on `cells`^2 congruent cells of some elements.
SampledElements sampledTriangles(const QuadraticSurface& surface, const std::vector<int>& elements,
                                 int cells);

/// Derivative by material points, one column each, of what has a density over the sampled points:
/// the points move as the elements interpolate the motion of the material points.
Eigen::Matrix3Xd byMaterialPoints(const MovingElements& moving, const SampledElements& sampled,
                                  const ShapeDensity& density);

/// Elements on which functions of some coefficients are nonzero, ascending.
std::vector<int> elementsOf(const ElementSurface& surface, std::span<const int> coefficients);
/// All elements of a surface.
std::vector<int> allElements(const ElementSurface& surface);

/// Block of a flat triangle, with the recovered displacement (DisplacementRecovery). `places`:
/// barycentric coordinates of its points; `points`: on the true surface; `tangents`: per point, the
/// derivatives of the true position (mm) along the edges from corner 0 to the corners 1 and 2,
/// whose coordinates run from 0 to 1.
FieldSampler::Block flatBlock(const BoundaryMesh& mesh, const TractionSlots& slots,
                              const DisplacementRecovery& recovery, int triangle,
                              std::vector<SampledPoint> points,
                              std::span<const Eigen::Vector3d> places,
                              std::span<const Eigen::Matrix<double, 3, 2>> tangents);

/// Orthonormal tangents and outward normal of a surface with the derivatives du, dv of its
/// position, and the matrix that turns derivatives along u and v into derivatives along the
/// tangents.
struct TangentFrame {
  TangentFrame(const Eigen::Vector3d& du, const Eigen::Vector3d& dv);
  Eigen::Matrix3d frame;
  Eigen::Matrix2d slopes;
};

}  // namespace palpa::bem

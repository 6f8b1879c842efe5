#pragma once

#include "bem/contact/contact_mask.h"
#include "bem/gradient/field_sampler.h"
#include "bem/gradient/shape_density.h"

namespace palpa::bem {

/// How the coefficients of a mask weight the projections of its bump on the elements around them:
/// by the integrals of their functions (splines) or by the areas of the elements (quadratic
/// triangles).
enum class MaskShares { kFunctions, kAreas };

/// A number that depends on a mask: J = Σ_a g_a φ_a + h·d, with its coefficients φ of traction and
/// the mean d of a field u (ElementContactSurface: 2 ∫ b u dΓ - ∫ Φ u dΓ).
struct MaskWork {
  Eigen::VectorXd ofTraction;  ///< g: one number per mask.nodes
  Eigen::Vector3d ofMean;      ///< h
};

/// Derivative of J by the motion of the surface; the coefficients of u stay with the material, the
/// mask moves with the material below its centre and keeps its radius. `blocks`: of all elements on
/// which functions of mask.nodes are nonzero, with the points of the projection; the density is
/// over their points. The derivative of the projection of ElementContactSurface is exact: masks
/// are hardly wider than elements, so that the derivative of the bump alone is wrong by some ten
/// per cent. `ofCentre` receives the derivative by the motion of the centre.
ShapeDensity maskDerivative(const std::vector<FieldSampler::Block>& blocks, const ContactMask& mask,
                            const MaskWork& work, MaskShares shares, const Eigen::VectorXd& u,
                            Eigen::Vector3d& ofCentre);

}  // namespace palpa::bem

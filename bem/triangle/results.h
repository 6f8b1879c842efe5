#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "bem/model/boundary_conditions.h"
#include "bem/model/bulk.h"
#include "bem/model/derived_quantities.h"
#include "bem/model/surface_point.h"

namespace palpa::bem {

class TriangleBodyForce;

/// Force and moment about the origin that the tractions `p` (3 per slot, MPa) exert on the body
/// over the given triangles; exact for the linear tractions.
Resultant tractionResultant(const BoundaryMesh& mesh, const TractionSlots& slots,
                            const Eigen::VectorXd& p, std::span<const int> triangles);

/// 1/2 ∫ p.u dΓ in N mm = mJ, the strain energy of a field without body force, with u between the
/// nodes from `DisplacementRecovery`. TriangleContactSurface is twenty times as fast.
double strainEnergy(const BoundaryMesh& mesh, const TractionSlots& slots, const Eigen::VectorXd& u,
                    const Eigen::VectorXd& p);

/// Cauchy stress at every slot (MPa), from the traction and the tangential derivatives of the
/// displacement: with n the normal, sigma n = p and, in the tangent plane, Hooke's law in the form
///   sigma_ab = 2 G [ e_ab + nu / (1 - nu) e_cc delta_ab ] + nu / (1 - nu) p_n delta_ab,
/// regular at nu = 0.5 (Brebbia, Telles & Wrobel, sect. 5.8). Each slot takes the area-weighted
/// mean of its triangles.
std::vector<Eigen::Matrix3d> surfaceStress(const BoundaryMesh& mesh, const TractionSlots& slots,
                                           const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                           const Material& material);

/// The same at one place: `frame` has two tangents and the normal as columns, `slopes` are the
/// derivatives of the displacement along the tangents.
Eigen::Matrix3d surfaceStress(const Eigen::Matrix3d& frame,
                              const Eigen::Matrix<double, 3, 2>& slopes,
                              const Eigen::Vector3d& traction, const Material& material);

/// sqrt(3/2 s:s) with s the deviator of `stress`.
double vonMises(const Eigen::Matrix3d& stress);

/// Displacement at any surface point from the boundary integral equation there (Sloan's iterate of
/// the collocation solution), mm. As accurate as the nodal values; interpolation between nodes
/// lacks a second-order term of several per cent under a load a few elements wide. `bodyForce`: the
/// mesh's tables, for callers with many points; null: made here if the bulk has a body force.
Eigen::Vector3d surfaceDisplacement(const BoundaryMesh& mesh, const TractionSlots& slots,
                                    const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                    const Bulk& bulk, const SurfacePoint& place,
                                    const TriangleBodyForce* bodyForce = nullptr);

/// Somigliana's identity: u = ∫ U p - ∫ T u, sigma = ∫ D p - ∫ S u, plus the terms of the body
/// force (bem/model/body_force.h). The displacement integrals are exact; the stress integrals use
/// subdivision, to about 1e-6. `bodyForce` as above. Empty for a point outside the body. Very close
/// to the surface, compared with an element, the stress has the kinks of the linear field: use
/// `surfaceStress` there.
std::optional<InteriorState> interiorState(const BoundaryMesh& mesh, const TractionSlots& slots,
                                           const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                                           const Bulk& bulk, const Eigen::Vector3d& point,
                                           const TriangleBodyForce* bodyForce = nullptr);

}  // namespace palpa::bem

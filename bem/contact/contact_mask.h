#pragma once

#include <vector>

#include "bem/model/boundary_conditions.h"
#include "bem/model/surface_point.h"

namespace palpa::bem {

/// Pressure mask of a contact (James & Pai, A unified treatment of elastostatic contact simulation,
/// Haptics-e 2001): a smooth bump of traction around a surface point, represented by the free
/// displacement coefficients around it, whose known traction acts on all their slots. A force f (N)
/// acts as the traction field f times Φ; its displacement is the mean d = Ψ u: ∫ Φ u dΓ, or on
/// curved elements the mean over the bump that Φ approximates (ElementContactSurface). The mask is
/// independent of the mesh in the limit, and continuous when the point slides.
struct ContactMask {
  SurfacePoint point{};
  double radius = 0;                    ///< mm; at least the requested radius
  std::vector<int> nodes;               ///< displacement coefficients whose slots carry traction
  std::vector<double> traction;         ///< their coefficients of Φ, 1/mm^2; ∫ Φ dΓ = 1
  std::vector<int> measureNodes;        ///< displacement coefficients that contribute to d
  std::vector<double> measure;          ///< Ψ: their weights; they sum to 1
  std::vector<Eigen::Vector3d> points;  ///< on the true surface, mm
  /// Mean of a given function f: Σ weight f(point); they sum to 1.
  std::vector<double> pointWeights;

  /// d = Ψ u for every column of u (3 rows per coefficient): 3 x columns.
  Eigen::MatrixXd displacement(const Eigen::MatrixXd& u) const;
};

class ContactSurface;

/// Mask (1 - (ρ/radius)^2)^2 for ρ = |x - point| < radius (mm), projected onto the free
/// coefficients of the connected piece of surface around the point and normalised. A radius below
/// ContactSurface::narrowestMask() is raised to it, because narrower bumps cannot be represented.
/// Throws SolverError (kBadCondition) if supports fix the whole touched place.
ContactMask makeContactMask(const ContactSurface& surface, const Eigen::Vector3d& at,
                            double radius);

}  // namespace palpa::bem

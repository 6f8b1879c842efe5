#pragma once

#include <span>
#include <vector>

#include "bem/model/derived_quantities.h"
#include "bem/model/traction_projection.h"
#include "bem/quadratic/quadratic_surface.h"

namespace palpa::bem {

/// Integrals over the elements: of the functions N of displacements and M of tractions, of these
/// times the position, and of their products; with them, resultants, energies and projections.
/// Const use from several threads is safe; the surface must outlive the integrals.
class QuadraticIntegrals {
 public:
  explicit QuadraticIntegrals(const QuadraticSurface& surface);

  /// Force (N) and moment (N mm) about the origin exerted on the body by the traction coefficients
  /// `p` (3 per slot, MPa) over the given elements.
  Resultant resultant(const Eigen::VectorXd& p, std::span<const int> elements) const;
  /// 1/2 ∫ p.u dΓ, mJ: the strain energy of a field without body force.
  double strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const;
  /// Integral of the function of a displacement coefficient, mm^2.
  double area(int coefficient) const { return areas_[coefficient]; }

  /// L2 projection of tractions given on some elements (zero elsewhere): 3 coefficients per slot,
  /// MPa. Preserves the net force, and the net moment on flat faces. `featureLength`: length over
  /// which the function varies, mm; infinite if it is smooth at the size of an element.
  Eigen::VectorXd projectTraction(const std::vector<int>& elements,
                                  const TractionFunction& traction, double featureLength) const;

 private:
  using Products = Eigen::Matrix<double, 6, 6>;
  struct Element {
    Eigen::Matrix<double, 4, 6> moments;  ///< per function of tractions: ∫ M (y, 1)
    Products products;                    ///< ∫ N_a M_b
  };

  const QuadraticSurface& surface_;
  std::vector<Element> elements_;
  std::vector<double> areas_;
};

}  // namespace palpa::bem

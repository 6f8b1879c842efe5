#pragma once

#include "bem/element/element_contact_surface.h"
#include "bem/quadratic/quadratic_discretisation.h"

namespace palpa::bem {

/// Quadratic triangles for contacts: Gauss points for bumps, projections on each element, and the
/// neighbours beyond the three edges.
class QuadraticContactElements final : public ContactElements {
 public:
  /// `narrowest`: radius of the narrowest mask on each element, mm.
  QuadraticContactElements(const QuadraticSurface& surface, const std::vector<double>& narrowest);
};

/// The surface of curved six-node triangles for contacts. The surface points are named by the
/// quarters of the elements.
class QuadraticContactSurface final : public ElementContactSurface {
 public:
  /// `discretisation` and `dofs` must outlive the surface.
  QuadraticContactSurface(const QuadraticDiscretisation& discretisation,
                          const DegreesOfFreedom& dofs);

  const std::vector<Eigen::Vector3d>& places() const override { return mesh().nodes; }
  /// A middle node of an edge: tractions with the function of a corner have no resultant.
  int coefficientAt(int meshNode) const override { return coefficientAt_[meshNode]; }

  SurfacePoint at(int triangle, const Eigen::Vector3d& weights) const override;
  SurfacePoint foot(const Eigen::Vector3d& tool, const SurfacePoint& start) const override;

  /// Mean of the elements at the nodes of the slot, between them quadratic: the normals of
  /// adjacent elements differ by a small angle.
  Eigen::Vector3d normal(const SurfacePoint& point) const override;
  Eigen::Vector3d smoothPosition(const SurfacePoint& point) const override;

  /// Radius of the narrowest mask over the longest edge of the elements around.
  static constexpr double kMinWidth = 1;
  double narrowestMask(const SurfacePoint& point) const override;
  double maskSpacing(const SurfacePoint& point) const override;

 private:
  const ContactElements& elements() const override { return elements_; }
  int elementAt(const SurfacePoint& point) const override { return point.triangle / 4; }
  std::vector<double> narrowestOfElements() const;

  const QuadraticSurface& surface_;
  std::vector<double> longestAt_;  ///< per node: longest edge of the elements around, mm
  QuadraticContactElements elements_;
  std::vector<int> coefficientAt_;
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <memory>
#include <string>
#include <vector>

#include "app/core/model/touch_model.h"
#include "bem/contact/contact_surface.h"

namespace palpa::app {

/// What the stiffness |force| / |deflection| of a touch means while the shape changes. The
/// deflection is the displacement of the first mask that the forces of the touch alone cause, as in
/// TouchState::Contact; so loads and other touches do not matter.
///
/// A grab or pin keeps the direction of its deflection; its force follows. A force, a push and a
/// ball keep the forces of their masks at present: the contact neither grows nor slides.
struct StiffnessRule {
  struct Mask {
    Eigen::Vector3d at;                               ///< mm, on the surface
    double radius;                                    ///< mm
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the unit force; unused by a grab
  };
  std::string name;
  std::vector<Mask> masks;
  /// Unit vector along the deflection that is kept; zero: the forces are kept.
  Eigen::Vector3d deflection = Eigen::Vector3d::Zero();

  bool keepsDeflection() const { return !deflection.isZero(0); }
};

/// The rule for a touch at rest. Throws SolverError (kBadCondition) if it has no force: then it has
/// no stiffness.
StiffnessRule stiffnessRuleOf(const TouchState::Contact& contact);

/// Stiffness of a touch and the two fields of its derivative, dk = − Σ a · dD f with the compliance
/// D of the masks, the forces f of the load and a of the adjoint field (docs/theory.md).
struct ContactStiffness {
  double value = 0;  ///< N/mm
  std::vector<bem::ContactMask> masks;
  /// Forces of the masks, N, one column each, and their fields: coefficients, one column.
  Eigen::Matrix3Xd loadForces, adjointForces;
  bem::BoundaryField load, adjoint;
};

/// Costs one or two solutions. Throws as bem::makeContactMask(), Cancelled.
ContactStiffness contactStiffness(const bem::ReferenceProblem& problem,
                                  const bem::ContactSurface& surface, const StiffnessRule& rule,
                                  const Job& job = {});

}  // namespace palpa::app

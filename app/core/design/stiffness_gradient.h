#pragma once

#include "app/core/design/boundary_gradient.h"
#include "app/core/design/contact_stiffness.h"
#include "app/core/design/design_surface.h"
#include "app/core/design/material_points.h"
#include "base/lazy.h"
#include "bem/gradient/residual_shape.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// Stiffness of a touch and its derivative by the control points.
struct StiffnessGradient {
  std::string name;           ///< of the touch
  double stiffness = 0;       ///< N/mm
  Eigen::Matrix3Xd gradient;  ///< N/mm per mm: one column per control point, in their order
};

/// Why a project has no gradients of stiffness, as a sentence for users: a mesh body, or supports
/// whose motion is not known. Empty if it has.
std::string gradientObstacle(const modeling::Project& project);

/// Gradients of stiffnesses by the control points of a model's solid (docs/theory.md, "Gradients by
/// the shape"). Supports on patches and the centres of masks move along with the material; half
/// spaces stay in space, as do the radii of masks and the directions of touches. Immutable; const
/// use from several threads is safe.
class StiffnessGradients {
 public:
  /// `project`: of `model`, which must outlive this object. Throws ModelingError for a mesh body;
  /// SolverError (kBadCondition) if a support is a roller, a stroke or a half space with
  /// exceptions, whose motion is not known (gradientObstacle()); Cancelled.
  StiffnessGradients(const modeling::Project& project, const TouchModel& model,
                     const Job& job = {});

  /// Costs two to four assemblies of the operators per touch.
  StiffnessGradient of(const StiffnessRule& rule, const Job& job = {}) const;
  Eigen::Matrix3Xd gradient(const ContactStiffness& stiffness, const Job& job = {}) const;

  /// Boundary form of the same gradient, from the traces of the fields alone (Eshelby's tensor):
  /// 1 to 2 ms for 10,000 points of surface(); the first call also prepares what touches share
  /// (docs/performance.md). Beside the borders of supports, where the energy is unbounded, it is
  /// wrong by as much as the gradient itself; elsewhere it shows where material makes the body
  /// stiffer.
  Eigen::Matrix3Xd boundaryForm(const ContactStiffness& stiffness, const Job& job = {}) const;

  const DesignSurface& surface() const { return surface_; }
  const bem::ContactSurface& contactSurface() const { return *contactSurface_; }

 private:
  /// Derivative by the projected masks (bem::maskDerivative()).
  Eigen::Matrix3Xd ofMasks(const ContactStiffness& stiffness, const Eigen::VectorXd& lambda) const;
  const TouchModel& model_;
  DesignSurface surface_;
  std::unique_ptr<bem::ContactSurface> contactSurface_;
  std::unique_ptr<bem::ResidualShape> shape_;
  MaterialPoints points_;
  Lazy<BoundaryGradient> boundary_;
};

}  // namespace palpa::app

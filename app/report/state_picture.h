#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "app/core/design/stiffness_gradient.h"
#include "app/core/results/drawn_body.h"
#include "app/view/viewport/picture.h"
#include "modeling/mesh/plane_section.h"
#include "modeling/project/project.h"

namespace palpa::report {

/// Options of `palpa-cli render` that say what a picture shows.
struct PictureOptions {
  app::SurfaceQuantity field = app::SurfaceQuantity::kDisplacement;
  std::vector<double> compliances;  ///< app::stiffnessMap(), for kStiffness
  /// Of one touch, by the control points: for arrows (`showGradient`) and kStiffnessGradient.
  std::optional<app::StiffnessGradient> gradient;
  bool showGradient = false;
  /// Ends of the colours, in the unit of the field; none: from the values.
  std::optional<std::array<double, 2>> range;
  std::optional<modeling::Plane> section;  ///< cuts the body
  bool showExtremes = false;               ///< marks the smallest and the largest value
  double displacementScale = 1;
  bool showUndeformed = true;
  bool showMeshEdges = false;
  bool showReactions = false;
  /// From the eye into the scene; if absent, a direction from which the touches are visible.
  std::optional<Eigen::Vector3d> viewDirection;
  bool parallel = false;
  double zoom = 1;
};

/// How the ring about a contact with this status is drawn.
view::ContactRing::State ringStateOf(app::TouchState::Status status);

/// The picture of a state: deformed surface, colours, force arrows with newtons, supports,
/// captions.
view::Picture makePicture(const modeling::Project& project,
                          const std::shared_ptr<const app::TouchModel>& model,
                          const app::TouchState& state, const PictureOptions& options);

}  // namespace palpa::report

#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "app/core/results/drawn_body.h"
#include "app/view/scene.h"
#include "modeling/project/project.h"

namespace palpa::cli {

struct SceneOptions {
  app::SurfaceQuantity field = app::SurfaceQuantity::kDisplacement;
  std::vector<double> compliances;  ///< app::stiffnessMap(), for kStiffness
  double displacementScale = 1;
  bool showUndeformed = true;
  bool showMeshEdges = false;
  bool showReactions = false;
  /// From the eye into the scene; chosen so that the touches are seen when absent.
  std::optional<Eigen::Vector3d> viewDirection;
  bool parallel = false;
  double zoom = 1;
};

/// The picture of a state: deformed surface, colours, force arrows with newtons, supports,
/// captions.
view::SurfaceScene makeScene(const modeling::Project& project,
                             const std::shared_ptr<const app::TouchModel>& model,
                             const app::TouchState& state, const SceneOptions& options);

}  // namespace palpa::cli

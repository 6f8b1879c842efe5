#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "app/core/touch_model.h"
#include "app/view/scene.h"
#include "modeling/project/project.h"

namespace palpa::cli {

/// What is drawn as colour.
enum class SceneField { kNone, kDisplacement, kNormalTraction, kVonMises };

struct SceneOptions {
  SceneField field = SceneField::kDisplacement;
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
view::SurfaceScene makeScene(const modeling::Project& project, const app::TouchModel& model,
                             const app::TouchState& state, const SceneOptions& options);

}  // namespace palpa::cli

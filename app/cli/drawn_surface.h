#pragma once

#include "app/cli/state_scene.h"

namespace palpa::cli {

/// The part of a scene that is the body itself: the solid's true surface, finer than the boundary
/// mesh, with displacements, colours and normals carried over from its nodes. At sharp edges the
/// points are split, so that neither normals nor colours that jump there blend across.
void addSurface(const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                const SceneOptions& options, view::SurfaceScene& scene);

}  // namespace palpa::cli

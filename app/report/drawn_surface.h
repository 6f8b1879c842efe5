#pragma once

#include "app/report/state_picture.h"

namespace palpa::report {

/// Adds the body itself to a picture: the true surface of the solid, finer than the boundary mesh,
/// with displacements, colours and normals from the nodes. At sharp edges the points are split, so
/// that neither normals nor colours that jump there blend across.
void addSurface(const std::shared_ptr<const app::TouchModel>& model, const app::TouchState& state,
                const PictureOptions& options, view::Picture& picture);

}  // namespace palpa::report

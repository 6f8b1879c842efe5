#pragma once
#include "bem/spline/spline_surface.h"
#include "modeling/solid/solid.h"

namespace palpa::app {

/// A solid's patches in the terms of the spline discretisation, over the same control points.
bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid);

}  // namespace palpa::app

#pragma once

#include "bem/model/body_force.h"
#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Volume moments of the body, by Gauss rules of degree + 4 points per direction.
VolumeMoments volumeMoments(const SplineSurface& surface);

/// Work of a uniform body force, by the same rules.
BodyForceWork bodyForceWork(const SplineSurface& surface, const SplineTractions& tractions,
                            const Bulk& bulk);

}  // namespace palpa::bem

#pragma once
#include "bem/contact_surface.h"

namespace palpa::bem {

/// The surface point below a tool: where the line along the surface's smooth normal goes through
/// `tool`. The nearest point of the triangles would stay at an edge while the tool moves by its
/// height times the angle between them, and then hurry on. Newton's method from `start`, a point
/// near it such as the nearest one; that point's surface only, so that at a sharp edge the foot
/// stays where the face ends.
SurfacePoint smoothFoot(const ContactSurface& surface, const Eigen::Vector3d& tool,
                        const SurfacePoint& start);

}  // namespace palpa::bem

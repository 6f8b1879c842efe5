#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/gui/view/surface_place.h"
#include "modeling/body/region.h"

// What a round brush does on the surface.
namespace palpa::gui {

/// Where the sphere about `centre` cuts the triangles: the border of what a brush of this radius
/// (mm) paints, as arcs.
std::vector<std::vector<Eigen::Vector3d>> ringOnSurface(const ShownSurface& surface,
                                                        const Eigen::Vector3d& centre,
                                                        double radius);

/// The stroke without its points nearer to `centre` than `radius` or its own radius, so that
/// afterwards nothing is painted at `centre`: in up to as many pieces as it has points.
std::vector<modeling::Stroke> withoutNear(const modeling::Stroke& stroke,
                                          const Eigen::Vector3d& centre, double radius);

}  // namespace palpa::gui

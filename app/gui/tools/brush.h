#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/gui/view/surface_place.h"
#include "modeling/body/region.h"

// Geometry of a round brush on the surface.
namespace palpa::gui {

/// Intersection of the sphere about `centre` with the triangles, as arcs: the border of a brush of
/// this radius (mm).
std::vector<std::vector<Eigen::Vector3d>> ringOnSurface(const ShownSurface& surface,
                                                        const Eigen::Vector3d& centre,
                                                        double radius);

/// The stroke without its points nearer to `centre` than `radius` or the stroke's radius, so that
/// it no longer covers `centre`. Returns at most as many pieces as the stroke has points.
std::vector<modeling::Stroke> withoutNear(const modeling::Stroke& stroke,
                                          const Eigen::Vector3d& centre, double radius);

}  // namespace palpa::gui

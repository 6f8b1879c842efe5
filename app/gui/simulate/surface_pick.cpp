#include "app/gui/simulate/surface_pick.h"

#include <Eigen/Geometry>

namespace palpa::gui {

std::optional<SurfacePick> pickSurface(const Simulation& simulation, const ViewportWidget& widget,
                                       const Eigen::Vector2d& pixel) {
  const app::DrawnBody* body = simulation.drawn();
  if (!body) return std::nullopt;
  const auto hit = widget.viewport().surfaceAt(pixel);
  if (!hit) return std::nullopt;
  const auto& [a, b, c] = body->mesh().triangles[static_cast<std::size_t>(hit->triangle)];
  const auto& drawn = simulation.shape().positions;
  const Eigen::Vector3d p = drawn[b] - drawn[a], q = drawn[c] - drawn[a],
                        r = hit->position - drawn[a];
  const Eigen::Vector3d area = p.cross(q);
  const double s = r.cross(q).dot(area) / area.squaredNorm();
  const double t = p.cross(r).dot(area) / area.squaredNorm();
  const auto& unloaded = body->mesh().positions;
  const auto& normals = simulation.shape().normals;
  return SurfacePick{(1 - s - t) * unloaded[a] + s * unloaded[b] + t * unloaded[c], hit->position,
                     ((1 - s - t) * normals[a] + s * normals[b] + t * normals[c]).normalized()};
}

}  // namespace palpa::gui

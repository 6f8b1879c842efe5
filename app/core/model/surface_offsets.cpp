#include "app/core/model/surface_offsets.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <variant>

#include "base/parallel.h"
#include "modeling/measure/measured_surface.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Edges of one step of the loop, so that a step is long enough for a thread.
constexpr std::size_t kEdgesPerStep = 32;
/// Largest offset over the length of an edge.
constexpr double kFarthest = 0.5;

/// An edge of the mesh, as side `corner` to the next one of a triangle.
struct Edge {
  int triangle, corner;
};

}  // namespace

SurfaceOffsets::SurfaceOffsets(const modeling::Body& body, const bem::Discretisation& on,
                               bool isExact, const Job& job) {
  const bem::BoundaryMesh& mesh = on.mesh();
  ofTriangle.assign(static_cast<std::size_t>(mesh.triangleCount()), 0);
  if (isExact) return;
  // Means of the middles of the edges are exact for offsets that vary quadratically.
  std::vector<Edge> edges;
  std::vector<std::array<std::size_t, 3>> edgesOf(ofTriangle.size());
  std::map<std::pair<int, int>, std::size_t> found;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto& corners = mesh.triangles[static_cast<std::size_t>(t)];
      const auto [at, isNew] =
          found.try_emplace(std::minmax(corners[k], corners[(k + 1) % 3]), edges.size());
      if (isNew) edges.push_back({t, k});
      edgesOf[static_cast<std::size_t>(t)][k] = at->second;
    }
  const auto surface =
      std::visit([](const auto& each) { return modeling::makeMeasuredSurface(each); }, body);
  std::vector<Vector3d> offsets(edges.size());
  const auto offsetOf = [&](const Edge& edge) -> Vector3d {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(edge.triangle)];
    Vector3d weights = Vector3d::Constant(0.5);
    weights[(edge.corner + 2) % 3] = 0;
    const Vector3d x =
        on.position({edge.triangle, weights, mesh.point(edge.triangle, weights), 0.0});
    const double length = (mesh.nodes[static_cast<std::size_t>(corners[edge.corner])] -
                           mesh.nodes[static_cast<std::size_t>(corners[(edge.corner + 1) % 3])])
                              .norm();
    const Vector3d offset = surface->nearest(x) - x;
    return offset.norm() < kFarthest * length ? offset : Vector3d::Zero();
  };
  const std::size_t steps = (edges.size() + kEdgesPerStep - 1) / kEdgesPerStep;
  parallelFor(static_cast<std::ptrdiff_t>(steps), job, [&](std::ptrdiff_t step) {
    const std::size_t first = static_cast<std::size_t>(step) * kEdgesPerStep;
    const std::size_t end = std::min(first + kEdgesPerStep, edges.size());
    for (std::size_t k = first; k < end; ++k) offsets[k] = offsetOf(edges[k]);
  });
  for (std::size_t t = 0; t < ofTriangle.size(); ++t) {
    const Vector3d normal = mesh.normal(static_cast<int>(t));
    for (const std::size_t edge : edgesOf[t]) ofTriangle[t] += offsets[edge].dot(normal) / 3;
  }
}

}  // namespace palpa::app

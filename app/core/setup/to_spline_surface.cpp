#include "app/core/setup/to_spline_surface.h"

#include "modeling/mesh/node_place.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {

bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid) {
  return splineSurfaceOf(
      solid, modeling::smoothingGroups(
                 solid, modeling::sharpEdges(solid, modeling::SurfaceEvaluator(solid))));
}

bem::SplineSurface splineSurfaceOf(const modeling::Solid& solid,
                                   const std::vector<int>& smoothingGroups) {
  std::vector<bem::SplinePatch> patches;
  for (std::size_t p = 0; p < solid.patches().size(); ++p) {
    const modeling::Patch& from = solid.patches()[p];
    bem::SplinePatch patch{{bem::BsplineBasis(from.degree[0], from.knots[0]),
                            bem::BsplineBasis(from.degree[1], from.knots[1])},
                           {},
                           smoothingGroups[p]};
    for (int j = 0; j < patch.basis[1].count(); ++j)
      for (int i = 0; i < patch.basis[0].count(); ++i) patch.net.push_back(from.net[i][j]);
    patches.push_back(std::move(patch));
  }
  return {solid.controlPoints(), std::move(patches)};
}

std::vector<bem::SplineMesh::Triangle> splineTriangles(const modeling::Solid& solid,
                                                       const modeling::SurfaceEvaluator& surface,
                                                       const modeling::SurfaceMesh& mesh) {
  std::vector<modeling::NodePlace> places;
  places.reserve(mesh.parameters.size());
  for (const modeling::SurfaceParameter& at : mesh.parameters)
    places.push_back(modeling::placeOf(solid, surface, at));
  std::vector<bem::SplineMesh::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    const int patch = mesh.patchOfTriangle[t];
    const auto corners =
        modeling::cornersIn(surface, patch, {&places[c[0]], &places[c[1]], &places[c[2]]});
    bem::SplineMesh::Triangle& triangle = triangles.emplace_back();
    triangle.patch = patch;
    for (int k = 0; k < 3; ++k) triangle.corners[k] = {corners[k].u, corners[k].v};
  }
  return triangles;
}

}  // namespace palpa::app

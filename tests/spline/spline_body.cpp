#include "spline_body.h"

#include "app/core/setup/to_spline_surface.h"
#include "modeling/mesh/mesh.h"

namespace palpa::bem::test {

using Eigen::Vector3d;

std::unique_ptr<SplineDiscretisation> discretised(
    const modeling::Solid& solid, double edgeLength,
    const std::function<int(const Vector3d&)>& tagOf) {
  SplineSurface surface = app::splineSurfaceOf(solid);
  for (int e = 0; e < surface.elementCount(); ++e) surface.setTag(e, tagOf(middleOf(surface, e)));
  modeling::MeshSettings settings;
  settings.edgeLength = edgeLength;
  const modeling::SurfaceMesh from = modeling::mesh(solid, settings);
  BoundaryMesh mesh{from.positions, from.triangles, from.smoothingGroupOfTriangle, {}};
  std::vector<SplineMesh::Triangle> triangles =
      app::splineTriangles(solid, modeling::SurfaceEvaluator(solid), from);
  for (const SplineMesh::Triangle& triangle : triangles) {
    const Eigen::Vector2d middle =
        (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3;
    const auto places = placesInPatch(surface, triangle.patch, middle[0], middle[1]);
    mesh.tags.push_back(surface.elements()[places.front().element].tag);
  }
  return std::make_unique<SplineDiscretisation>(std::move(mesh), std::move(surface),
                                                std::move(triangles));
}

std::vector<SlotCondition> fixedWhereTagged(const TractionSlots& slots) {
  std::vector<SlotCondition> conditions;
  for (const auto& slot : slots.slots)
    conditions.push_back(slot.tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction);
  return conditions;
}

}  // namespace palpa::bem::test

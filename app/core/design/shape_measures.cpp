#include "app/core/design/shape_measures.h"

#include <algorithm>
#include <numeric>

#include "modeling/editing/nearest_on_patches.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"
#include "modeling/measure/patch_search.h"

namespace palpa::app {

using Eigen::Vector3d;

ShapeMeasure volumeOf(const DesignSurface& surface) {
  bem::ShapeDensity density(surface.sampler.pointCount());
  double volume = 0;
  for (int q = 0; q < surface.sampler.pointCount(); ++q) {
    const bem::SampledPoint& point = surface.sampler.points()[q];
    density.value.col(q) = point.weight * point.frame.col(2);
    volume += density.value.col(q).dot(point.position) / 3;
  }
  return {volume, surface.basis.gradient(density)};
}

ShapeMeasure areaOf(const DesignSurface& surface) {
  bem::ShapeDensity density(surface.sampler.pointCount());
  for (int q = 0; q < surface.sampler.pointCount(); ++q) {
    const bem::SampledPoint& point = surface.sampler.points()[q];
    density.slope.middleCols<2>(2 * q) = point.weight * point.frame.leftCols<2>();
  }
  return {surface.sampler.area(), surface.basis.gradient(density)};
}

std::optional<ShapeMeasure> massOf(const DesignSurface& surface,
                                   const modeling::Material& material) {
  if (!material.densityKgPerM3) return std::nullopt;
  ShapeMeasure mass = volumeOf(surface);
  const double density = *material.densityKgPerM3 * 1e-9;  // kg/mm^3
  mass.value *= density;
  mass.gradient *= density;
  return mass;
}

namespace {

bool areNeighbours(const modeling::Solid& solid, int a, int b) {
  return a == b || std::any_of(solid.edges().begin(), solid.edges().end(),
                               [&](const modeling::SolidEdge& edge) {
                                 return (edge.uses[0].patch == a && edge.uses[1].patch == b) ||
                                        (edge.uses[0].patch == b && edge.uses[1].patch == a);
                               });
}

/// True if the surface at the far end faces away from the near end: within 60°, on the same or
/// a neighbouring patch within 25°, because beside an edge or a dent the ray may leave through the
/// surface there, which is no wall.
bool isOpposite(const modeling::Solid& solid, const modeling::PatchSearch& search, int patch,
                const modeling::MeasuredValue& wall) {
  constexpr double kFacing = 0.5, kNeighbourFacing = 0.9;
  const modeling::PatchPoint end = search.nearest(wall.points[1]);
  const modeling::PatchJet jet = search.jet(end.patch, end.uv);
  return jet.u.cross(jet.v).normalized().dot((wall.points[1] - wall.points[0]).normalized()) >
         (areNeighbours(solid, patch, end.patch) ? kNeighbourFacing : kFacing);
}

}  // namespace

std::vector<WallThickness> wallThicknesses(const modeling::Solid& solid,
                                           const std::vector<int>& patches, const Job& job) {
  constexpr int kPerDirection = 6;
  const modeling::MeasuredBody body{modeling::Body(solid)};
  const modeling::PatchSearch search(solid);
  std::vector<WallThickness> walls;
  for (const int patch : patches)
    for (int i = 0; i < kPerDirection; ++i)
      for (int j = 0; j < kPerDirection; ++j) {
        job.throwIfCancelled();
        modeling::Measurement measurement;
        measurement.kind = modeling::MeasurementKind::kThickness;
        modeling::MeasuredPlace place;
        place.patch = solid.patches()[static_cast<std::size_t>(patch)].name;
        place.at = Eigen::Vector2d((i + 0.5) / kPerDirection, (j + 0.5) / kPerDirection);
        measurement.places.push_back(place);
        try {
          const modeling::MeasuredValue value = body.measure(measurement);
          if (!isOpposite(solid, search, patch, value)) continue;
          walls.push_back(
              {patch, i * kPerDirection + j, value.value, {value.points[0], value.points[1]}});
        } catch (const modeling::ModelingError&) {
          continue;  // no surface lies opposite
        }
      }
  return walls;
}

Eigen::Matrix3Xd WallThickness::gradient(const modeling::Solid& solid) const {
  Eigen::Matrix3Xd result =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(solid.controlPoints().size()));
  const Vector3d along = (ends[1] - ends[0]).normalized();
  modeling::NearestOnPatches nearest(solid);
  for (std::size_t end = 0; end < 2; ++end)
    for (const auto& [point, weight] : nearest.of(ends[end]))
      result.col(point) += (end == 0 ? -weight : weight) * along;
  return result;
}

std::optional<ShapeMeasure> smallestThickness(const modeling::Solid& solid) {
  std::vector<int> patches(solid.patches().size());
  std::iota(patches.begin(), patches.end(), 0);
  const std::vector<WallThickness> walls = wallThicknesses(solid, patches);
  if (walls.empty()) return std::nullopt;
  const auto thinnest = std::min_element(
      walls.begin(), walls.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return ShapeMeasure{thinnest->value, thinnest->gradient(solid)};
}

}  // namespace palpa::app

#include "app/core/design/shape_measures.h"

#include "modeling/editing/nearest_on_patches.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"

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

std::optional<ShapeMeasure> smallestThickness(const modeling::Solid& solid) {
  constexpr int kPerDirection = 6;
  const modeling::MeasuredBody body{modeling::Body(solid)};
  std::optional<modeling::MeasuredValue> thinnest;
  for (const modeling::Patch& patch : solid.patches())
    for (int i = 0; i < kPerDirection; ++i)
      for (int j = 0; j < kPerDirection; ++j) {
        modeling::Measurement measurement;
        measurement.kind = modeling::MeasurementKind::kThickness;
        modeling::MeasuredPlace place;
        place.patch = patch.name;
        place.at = Eigen::Vector2d((i + 0.5) / kPerDirection, (j + 0.5) / kPerDirection);
        measurement.places.push_back(place);
        try {
          const modeling::MeasuredValue value = body.measure(measurement);
          if (!thinnest || value.value < thinnest->value) thinnest = value;
        } catch (const modeling::ModelingError&) {
          continue;  // no surface lies opposite
        }
      }
  if (!thinnest) return std::nullopt;
  ShapeMeasure result{
      thinnest->value,
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(solid.controlPoints().size()))};
  const Vector3d along = (thinnest->points[1] - thinnest->points[0]).normalized();
  modeling::NearestOnPatches nearest(solid);
  for (int end = 0; end < 2; ++end)
    for (const auto& [point, weight] : nearest.of(thinnest->points[end]))
      result.gradient.col(point) += (end == 0 ? -weight : weight) * along;
  return result;
}

}  // namespace palpa::app

#include "app/report/dimensions.h"

#include <cmath>
#include <numbers>

#include "app/report/text.h"
#include "bem/model/surface_point.h"
#include "modeling/error.h"
#include "modeling/measure/measured_body.h"

namespace palpa::report {
namespace {

using modeling::MeasuredValue;
using modeling::MeasurementKind;

view::Dimension atRest(MeasurementKind kind, const MeasuredValue& value) {
  using Kind = view::Dimension::Kind;
  switch (kind) {
    case MeasurementKind::kLength:
      return {Kind::kCurve, value.points, format("%.5g mm", value.value)};
    case MeasurementKind::kAngle:
      return {Kind::kAngle, value.points, format("%.5g°", value.value * 180 / std::numbers::pi)};
    case MeasurementKind::kRadius:
      return {Kind::kRadius, value.points,
              std::isfinite(value.value) ? format("R %.5g mm", std::abs(value.value)) : "flat"};
    case MeasurementKind::kDistance:
    case MeasurementKind::kThickness:
      break;
  }
  return {Kind::kLinear, value.points, format("%.5g mm", value.value)};
}

}  // namespace

std::vector<view::Dimension> dimensionsOf(const modeling::Project& project,
                                          const app::TouchModel& model,
                                          const app::TouchState& state, double scale) {
  std::vector<view::Dimension> dimensions;
  if (project.measurements.empty()) return dimensions;
  const modeling::MeasuredBody body(project.body);
  const bool isDisplaced = !state.field.u.isZero(0);
  for (const modeling::Measurement& each : project.measurements) {
    try {
      const MeasuredValue value = body.measure(each);
      view::Dimension dimension = atRest(each.kind, value);
      if (isDisplaced) {
        if (dimension.kind != view::Dimension::Kind::kLinear) continue;
        std::array<Eigen::Vector3d, 2> moved;
        for (std::size_t k = 0; k < 2; ++k) {
          const Eigen::Vector3d u = model.setup().discretisation->interpolate(
              bem::nearestSurfacePoint(model.setup().mesh(), value.points[k]),
              state.field.u.col(0));
          moved[k] = value.points[k] + u;
          dimension.points[k] = value.points[k] + scale * u;
        }
        dimension.text =
            format("%.4g mm (at rest %.4g mm)", (moved[1] - moved[0]).norm(), value.value);
      }
      dimensions.push_back(std::move(dimension));
    } catch (const modeling::ModelingError&) {
      // `measure` reports it.
    }
  }
  return dimensions;
}

}  // namespace palpa::report

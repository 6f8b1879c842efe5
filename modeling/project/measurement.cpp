#include "modeling/project/measurement.h"

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

using What = MeasuredPlace::What;

bool isIn(double fraction) {
  return fraction >= 0.0 && fraction <= 1.0;
}

void checkPlace(const MeasuredPlace& place, const std::string& path) {
  if (place.patch.empty()) throw ModelingError(path + ".patch: is empty");
  if (const auto* uv = std::get_if<Eigen::Vector2d>(&place.at)) {
    for (int k = 0; k < 2; ++k)
      if (!isIn((*uv)[k]))
        throw ModelingError(path + ".uv[" + std::to_string(k) + "]: is outside the range 0 … 1");
    if ((place.what == What::kEdge) != place.side.has_value())
      throw ModelingError(path + ".side: an edge of a solid needs it, a point or a face has none");
    return;
  }
  if (!std::get<Eigen::Vector3d>(place.at).allFinite())
    throw ModelingError(path + ".at_mm: must be finite");
  if ((place.what == What::kEdge) == place.other.empty())
    throw ModelingError(path +
                        ".other: an edge of a mesh body needs the face on its other side, a point "
                        "or a face has none");
}

}  // namespace

void checkMeasurement(const Measurement& measurement, const std::string& path) {
  const MeasurementKindInfo& info = infoOf(measurement.kind);
  const auto& places = measurement.places;
  if (places.size() < info.leastPlaces || places.size() > info.mostPlaces)
    throw ModelingError(path + ".places: a measurement of the kind " + info.name + " needs " +
                        std::to_string(info.leastPlaces) +
                        (info.mostPlaces > info.leastPlaces
                             ? " or " + std::to_string(info.mostPlaces)
                             : std::string()) +
                        " of them, found " + std::to_string(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string at = path + ".places[" + std::to_string(i) + "]";
    checkPlace(places[i], at);
    const What what = places[i].what;
    const auto require = [&](bool fits, const char* words) {
      if (!fits) throw ModelingError(at + ".what: " + words);
    };
    switch (measurement.kind) {
      case MeasurementKind::kDistance:
        break;
      case MeasurementKind::kLength:
        require(what == What::kEdge, "a length belongs to an edge");
        break;
      case MeasurementKind::kAngle:
        require((what == What::kPoint) == (places.size() == 3),
                "an angle lies between three points, or between two edges or faces");
        break;
      case MeasurementKind::kThickness:
        require(what == What::kPoint, "a wall thickness is measured at a point");
        break;
      case MeasurementKind::kRadius:
        require(what != What::kFace, "a radius is measured at a point or on an edge");
        break;
    }
  }
}

}  // namespace palpa::modeling

#include <utility>

#include "base/text.h"
#include "modeling/project/json_values.h"

// Primitives are read and written here, side by side, because every shape has keys of its own.
namespace palpa::modeling {

using nlohmann::json;

namespace {

ProfileCurve profileFrom(const json& value) {
  ProfileCurve profile{value["degree"], value["knots"], {}};
  for (const json& point : value["points_mm"])
    profile.points.emplace_back(point[0].get<double>(), point[1].get<double>());
  return profile;
}

std::string profileText(const ProfileCurve& profile) {
  const auto pointText = [](const Eigen::Vector2d& point) {
    return "[" + numberText(point.x()) + ", " + numberText(point.y()) + "]";
  };
  return "{\"degree\": " + std::to_string(profile.degree) +
         ", \"knots\": " + listText(profile.knots, numberText) +
         ", \"points_mm\": " + listText(profile.points, pointText) + "}";
}

decltype(Primitive::shape) shapeFrom(const json& value) {
  const auto length = [&](const char* key) { return value[key].get<double>(); };
  const std::string kind = value["kind"];
  if (kind == "box") return BoxShape{vectorFrom(value["size_mm"])};
  if (kind == "sphere") return SphereShape{length("radius_mm")};
  if (kind == "ellipsoid") return EllipsoidShape{vectorFrom(value["radii_mm"])};
  if (kind == "cylinder") return CylinderShape{length("radius_mm"), length("height_mm")};
  if (kind == "cone")
    return ConeShape{length("bottom_radius_mm"), length("top_radius_mm"), length("height_mm")};
  if (kind == "capsule") return CapsuleShape{length("radius_mm"), length("length_mm")};
  if (kind == "torus") return TorusShape{length("major_radius_mm"), length("minor_radius_mm")};
  if (kind == "revolve") return RevolveShape{profileFrom(value["profile"])};
  if (kind == "extrude") return ExtrudeShape{profileFrom(value["profile"]), length("height_mm")};
  LoftShape loft;
  for (const json& section : value["sections"])
    loft.sections.push_back({section["z_mm"].get<double>(), profileFrom(section["profile"])});
  return loft;
}

std::string lengthText(const char* key, double value) {
  return std::string(", \"") + key + "\": " + numberText(value);
}

std::string shapeText(const BoxShape& shape) {
  return "\"box\", \"size_mm\": " + vectorText(shape.size);
}

std::string shapeText(const SphereShape& shape) {
  return "\"sphere\"" + lengthText("radius_mm", shape.radius);
}

std::string shapeText(const EllipsoidShape& shape) {
  return "\"ellipsoid\", \"radii_mm\": " + vectorText(shape.radii);
}

std::string shapeText(const CylinderShape& shape) {
  return "\"cylinder\"" + lengthText("radius_mm", shape.radius) +
         lengthText("height_mm", shape.height);
}

std::string shapeText(const ConeShape& shape) {
  return "\"cone\"" + lengthText("bottom_radius_mm", shape.bottomRadius) +
         lengthText("top_radius_mm", shape.topRadius) + lengthText("height_mm", shape.height);
}

std::string shapeText(const CapsuleShape& shape) {
  return "\"capsule\"" + lengthText("radius_mm", shape.radius) +
         lengthText("length_mm", shape.length);
}

std::string shapeText(const TorusShape& shape) {
  return "\"torus\"" + lengthText("major_radius_mm", shape.majorRadius) +
         lengthText("minor_radius_mm", shape.minorRadius);
}

std::string shapeText(const RevolveShape& shape) {
  return "\"revolve\", \"profile\": " + profileText(shape.profile);
}

std::string shapeText(const ExtrudeShape& shape) {
  return "\"extrude\", \"profile\": " + profileText(shape.profile) +
         lengthText("height_mm", shape.height);
}

std::string shapeText(const LoftShape& shape) {
  const auto sectionText = [](const LoftShape::Section& section) {
    return "{\"z_mm\": " + numberText(section.z) +
           ", \"profile\": " + profileText(section.profile) + "}";
  };
  return "\"loft\", \"sections\": " + listText(shape.sections, sectionText);
}

}  // namespace

Primitive primitiveFrom(const json& value) {
  Primitive primitive;
  primitive.shape = shapeFrom(value);
  primitive.degree = value.value("degree", primitive.degree);
  primitive.controlPoints = value.value("control_points", primitive.controlPoints);
  return primitive;
}

std::string primitiveText(const Primitive& primitive) {
  std::string text =
      "{\"kind\": " +
      std::visit([](const auto& shape) { return shapeText(shape); }, primitive.shape) +
      ", \"degree\": " + std::to_string(primitive.degree);
  if (primitive.controlPoints != 0)
    text += ", \"control_points\": " + std::to_string(primitive.controlPoints);
  return text + "}";
}

}  // namespace palpa::modeling

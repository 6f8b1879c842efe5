#include <utility>

#include "modeling/project/json_values.h"

// Reading and writing of primitives, side by side because every shape has different keys.
namespace palpa::modeling {

using nlohmann::json;

ProfileCurve profileFrom(const json& value) {
  ProfileCurve profile{value["degree"], value["knots"], {}};
  for (const json& point : value["points_mm"])
    profile.points.emplace_back(point[0].get<double>(), point[1].get<double>());
  return profile;
}

std::vector<LoftShape::Section> sectionsFrom(const json& list) {
  std::vector<LoftShape::Section> sections;
  for (const json& section : list)
    sections.push_back({section["z_mm"].get<double>(), profileFrom(section["profile"])});
  return sections;
}

namespace {

using modeling::jsonOf;

Json jsonOf(const ProfileCurve& profile) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point : profile.points) points.push_back({point.x(), point.y()});
  return {{"degree", profile.degree}, {"knots", profile.knots}, {"points_mm", std::move(points)}};
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
  return LoftShape{sectionsFrom(value["sections"])};
}

Json jsonOf(const BoxShape& shape) {
  return {{"kind", "box"}, {"size_mm", jsonOf(shape.size)}};
}

Json jsonOf(const SphereShape& shape) {
  return {{"kind", "sphere"}, {"radius_mm", shape.radius}};
}

Json jsonOf(const EllipsoidShape& shape) {
  return {{"kind", "ellipsoid"}, {"radii_mm", jsonOf(shape.radii)}};
}

Json jsonOf(const CylinderShape& shape) {
  return {{"kind", "cylinder"}, {"radius_mm", shape.radius}, {"height_mm", shape.height}};
}

Json jsonOf(const ConeShape& shape) {
  return {{"kind", "cone"},
          {"bottom_radius_mm", shape.bottomRadius},
          {"top_radius_mm", shape.topRadius},
          {"height_mm", shape.height}};
}

Json jsonOf(const CapsuleShape& shape) {
  return {{"kind", "capsule"}, {"radius_mm", shape.radius}, {"length_mm", shape.length}};
}

Json jsonOf(const TorusShape& shape) {
  return {{"kind", "torus"},
          {"major_radius_mm", shape.majorRadius},
          {"minor_radius_mm", shape.minorRadius}};
}

Json jsonOf(const RevolveShape& shape) {
  return {{"kind", "revolve"}, {"profile", jsonOf(shape.profile)}};
}

Json jsonOf(const ExtrudeShape& shape) {
  return {{"kind", "extrude"}, {"profile", jsonOf(shape.profile)}, {"height_mm", shape.height}};
}

Json jsonOf(const LoftShape& shape) {
  Json sections = Json::array();
  for (const LoftShape::Section& section : shape.sections)
    sections.push_back(Json{{"z_mm", section.z}, {"profile", jsonOf(section.profile)}});
  return {{"kind", "loft"}, {"sections", std::move(sections)}};
}

}  // namespace

Primitive primitiveFrom(const json& value) {
  Primitive primitive;
  primitive.shape = shapeFrom(value);
  primitive.degree = value.value("degree", primitive.degree);
  primitive.controlPoints = value.value("control_points", primitive.controlPoints);
  return primitive;
}

Json jsonOf(const Primitive& primitive) {
  Json object = std::visit([](const auto& shape) { return jsonOf(shape); }, primitive.shape);
  object["degree"] = primitive.degree;
  if (primitive.controlPoints != 0) object["control_points"] = primitive.controlPoints;
  return object;
}

}  // namespace palpa::modeling

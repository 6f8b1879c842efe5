#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "modeling/project/json_print.h"
#include "modeling/project/project.h"

// Values of a project as JSON, shared by project files, command lists and recordings. The readers
// rely on checkAgainstSchema(); the writers give the keys in the order of files.
namespace palpa::modeling {

Eigen::Vector3d vectorFrom(const nlohmann::json& value);
Region regionFrom(const nlohmann::json& value);
Material materialFrom(const nlohmann::json& value);
/// Throws ModelingError as the constructors of Solid and MeshBody, and for wrong names and runs.
Solid solidFrom(const nlohmann::json& value);
MeshBody meshBodyFrom(const nlohmann::json& value);
Support supportFrom(const nlohmann::json& value);
Load loadFrom(const nlohmann::json& value);
Touch touchFrom(const nlohmann::json& value);
Measurement measurementFrom(const nlohmann::json& value);
Design designFrom(const nlohmann::json& value);
/// Reads a list of numbers, one part, or a list of both, where the numbers are one part of the
/// union.
PointSelection selectionFrom(const nlohmann::json& value);
MirrorPlane planeFrom(const nlohmann::json& value);
MeshSettings meshFrom(const nlohmann::json& value);

/// degree and control_points may be absent: 3 and the shape's default.
Primitive primitiveFrom(const nlohmann::json& value);
ProfileCurve profileFrom(const nlohmann::json& value);
std::vector<LoftShape::Section> sectionsFrom(const nlohmann::json& list);

/// Names of sides in files: u_min (in messages u-min).
Side sideFrom(const nlohmann::json& value);
std::string sideKey(Side side);

Json jsonOf(const Eigen::Vector3d& v);
Json jsonOf(const Region& region);
Json jsonOf(const Material& material);
Json jsonOf(const Solid& solid);
Json jsonOf(const MeshBody& body);
Json jsonOf(const Support& support);
Json jsonOf(const Load& load);
Json jsonOf(const Touch& touch);
Json jsonOf(const Measurement& measurement);
Json jsonOf(const Design& design);
/// A single part directly, several parts as a list.
Json jsonOf(const PointSelection& selection);
Json jsonOf(const MirrorPlane& plane);
Json jsonOf(const MeshSettings& mesh);
Json jsonOf(const Primitive& primitive);

template <class List>
Json jsonOfEach(const List& list) {
  Json result = Json::array();
  for (const auto& one : list) result.push_back(jsonOf(one));
  return result;
}

}  // namespace palpa::modeling

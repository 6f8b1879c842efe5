#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "modeling/project/project.h"

// Values of a project as JSON, shared by project files and command lists. The readers rely on
// checkAgainstSchema(); the writers give the stable text of project files.
namespace palpa::modeling {

Eigen::Vector3d vectorFrom(const nlohmann::json& value);
Region regionFrom(const nlohmann::json& value);
Material materialFrom(const nlohmann::json& value);
/// @throws ModelingError as the constructors of Solid and MeshBody, and for wrong names and runs
Solid solidFrom(const nlohmann::json& value);
MeshBody meshBodyFrom(const nlohmann::json& value);
Support supportFrom(const nlohmann::json& value);
Load loadFrom(const nlohmann::json& value);
Touch touchFrom(const nlohmann::json& value);
MeshSettings meshFrom(const nlohmann::json& value);

/// degree and control_points may be absent: 3 and the shape's default.
Primitive primitiveFrom(const nlohmann::json& value);

/// The names of kSides in files: u_min where messages say u-min.
Side sideFrom(const nlohmann::json& value);
std::string sideKey(Side side);

/// A string in quotes, with escapes; invalid UTF-8 is replaced.
std::string quoted(const std::string& text);

/// "[" + one element per line + "]" at the given indentation.
std::string linesText(const std::vector<std::string>& lines, const std::string& indent);

std::string vectorText(const Eigen::Vector3d& v);
std::string regionText(const Region& region);
std::string materialText(const Material& material);
std::string solidText(const Solid& solid);
std::string meshBodyText(const MeshBody& body);
std::string supportText(const Support& support);
std::string loadText(const Load& load);
std::string touchText(const Touch& touch);
std::string meshText(const MeshSettings& mesh);
std::string primitiveText(const Primitive& primitive);

/// "[a, b, c]" from any list, each element through `text`.
template <class List, class Text>
std::string listText(const List& list, Text text) {
  std::string result = "[";
  for (const auto& element : list) result += (result.size() > 1 ? ", " : "") + text(element);
  return result + "]";
}

}  // namespace palpa::modeling

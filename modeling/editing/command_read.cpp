#include <algorithm>

#include "modeling/editing/command_file.h"
#include "modeling/editing/command_names.h"
#include "modeling/error.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_values.h"
#include "modeling/project/migration.h"
#include "modeling/project/project_file.h"
#include "modeling/project/schema_check.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

std::optional<double> numberIf(const json& object, const char* key) {
  if (!object.contains(key)) return std::nullopt;
  return object[key].get<double>();
}

std::optional<Eigen::Vector3d> vectorIf(const json& object, const char* key) {
  if (!object.contains(key)) return std::nullopt;
  return vectorFrom(object[key]);
}

Reach reachFrom(const json& value) {
  Reach reach{numberIf(value, "falloff_mm"), std::nullopt};
  if (value.contains("mirror")) reach.mirror = planeFrom(value["mirror"]);
  return reach;
}

/// Reads one factor for all axes, or one per axis.
Eigen::Vector3d factorsFrom(const json& value) {
  if (value.contains("factors")) return vectorFrom(value["factors"]);
  return Eigen::Vector3d::Constant(value["factor"].get<double>());
}

Command movePointsFrom(const json& value) {
  MovePoints command{selectionFrom(value["points"]), {}, reachFrom(value)};
  if (value.contains("by_mm")) {
    command.how = MoveBy{vectorFrom(value["by_mm"])};
  } else if (value.contains("to_mm")) {
    MoveTo to;
    for (const json& position : value["to_mm"]) to.positions.push_back(vectorFrom(position));
    command.how = std::move(to);
  } else {
    command.how = MoveAlongNormal{value["along_normal_mm"]};
  }
  return command;
}

Command transformFrom(const json& value) {
  const auto center = [](const json& how) {
    return vectorIf(how, "center_mm").value_or(Eigen::Vector3d::Zero());
  };
  if (value.contains("translate_mm"))
    return TransformSolid{Translation{vectorFrom(value["translate_mm"])}};
  if (value.contains("rotate")) {
    const json& how = value["rotate"];
    return TransformSolid{Rotation{vectorFrom(how["axis"]), how["angle_deg"], center(how)}};
  }
  if (value.contains("scale"))
    return TransformSolid{Scaling{factorsFrom(value["scale"]), center(value["scale"])}};
  return TransformSolid{planeFrom(value["mirror"])};
}

int directionFrom(const json& value) {
  return value["direction"] == "u" ? 0 : 1;
}

using Reader = Command (*)(const json&);

/// In the order of kCommandNames.
constexpr std::array<Reader, std::variant_size_v<Command>> kReaders{
    movePointsFrom,
    [](const json& v) -> Command {
      return ScalePoints{selectionFrom(v["points"]), factorsFrom(v), vectorIf(v, "center_mm"),
                         reachFrom(v)};
    },
    [](const json& v) -> Command {
      return RotatePoints{selectionFrom(v["points"]), vectorFrom(v["axis"]), v["angle_deg"],
                          vectorIf(v, "center_mm"), reachFrom(v)};
    },
    [](const json& v) -> Command {
      return AlignPoints{selectionFrom(v["points"]), vectorIf(v, "normal"),
                         numberIf(v, "offset_mm")};
    },
    [](const json& v) -> Command {
      return InsertKnot{v["patch"], directionFrom(v), v["at"], v.value("times", 1)};
    },
    [](const json& v) -> Command {
      return RemoveKnot{v["patch"], directionFrom(v), v["at"], v.value("times", 1),
                        v["tolerance_mm"]};
    },
    [](const json& v) -> Command {
      return ElevateDegree{v["patch"], directionFrom(v), v["degree"]};
    },
    transformFrom,
    [](const json& v) -> Command { return MakePrimitive{primitiveFrom(v["primitive"])}; },
    [](const json& v) -> Command {
      return SetEdge{v["patch"], sideFrom(v["side"]), v["smooth"]};
    },
    [](const json& v) -> Command { return AddSupport{supportFrom(v["support"])}; },
    [](const json& v) -> Command {
      return SetSupport{v["name"], supportFrom(v["support"])};
    },
    [](const json& v) -> Command { return RemoveSupport{v["name"]}; },
    [](const json& v) -> Command {
      return TakeOverlap{v["name"], v["from"], v.value("gap_mm", 0.0)};
    },
    [](const json& v) -> Command { return AddLoad{loadFrom(v["load"])}; },
    [](const json& v) -> Command {
      return SetLoad{v["name"], loadFrom(v["load"])};
    },
    [](const json& v) -> Command { return RemoveLoad{v["name"]}; },
    [](const json& v) -> Command { return AddTouch{touchFrom(v["touch"])}; },
    [](const json& v) -> Command {
      return SetTouch{v["name"], touchFrom(v["touch"])};
    },
    [](const json& v) -> Command { return RemoveTouch{v["name"]}; },
    [](const json& v) -> Command { return AddMeasurement{measurementFrom(v["measurement"])}; },
    [](const json& v) -> Command {
      return SetMeasurement{v["name"], measurementFrom(v["measurement"])};
    },
    [](const json& v) -> Command { return RemoveMeasurement{v["name"]}; },
    [](const json& v) -> Command { return SetMaterial{materialFrom(v["material"])}; },
    [](const json& v) -> Command { return SetMesh{meshFrom(v["mesh"])}; },
    [](const json& v) -> Command {
      return v.contains("design") ? SetDesign{designFrom(v["design"])} : SetDesign{};
    },
    [](const json& v) -> Command { return RenameProject{v["name"]}; },
    [](const json& v) -> Command {
      return RenamePatch{v["patch"], v["name"]};
    }};

Command commandFrom(const json& value) {
  const std::string name = value["command"];
  const auto found = std::find(kCommandNames.begin(), kCommandNames.end(), name);
  return kReaders[found - kCommandNames.begin()](value);
}

}  // namespace

std::vector<Command> parseCommands(std::string_view text, const std::string& sourceName) {
  json document =
      parseGuarded(text, sourceName, {kMaxProjectFile, kMaxProjectValues, kDeepestNesting});
  if (document.is_array()) document = {{"commands", std::move(document)}};
  if (document.is_object() && document.contains("commands"))
    for (json& command : document["commands"])
      if (command.is_object() && command.contains("touch")) upgradeKind(command["touch"]);
  checkAgainstSchema(document, sourceName, SchemaName::kCommands);
  try {
    std::vector<Command> commands;
    for (const json& one : document["commands"]) commands.push_back(commandFrom(one));
    return commands;
  } catch (const json::exception& error) {
    throw ModelingError(sourceName + ": " + error.what());
  }
}

std::vector<Command> readCommands(const std::filesystem::path& path) {
  return parseCommands(readTextFile(path, kMaxProjectFile), path.string());
}

}  // namespace palpa::modeling

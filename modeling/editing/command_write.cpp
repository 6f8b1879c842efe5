#include <array>

#include "modeling/editing/command_file.h"
#include "modeling/editing/command_names.h"
#include "modeling/project/json_values.h"

namespace palpa::modeling {
namespace {

using modeling::jsonOf;

Json jsonOf(double value) {
  return value;
}

template <class T>
void addIf(Json& object, const char* key, const std::optional<T>& value) {
  if (value) object[key] = jsonOf(*value);
}

void add(Json& object, const Reach& reach) {
  addIf(object, "falloff_mm", reach.falloff);
  addIf(object, "mirror", reach.mirror);
}

void add(Json& object, const MoveBy& how) {
  object["by_mm"] = jsonOf(how.vector);
}
void add(Json& object, const MoveTo& how) {
  object["to_mm"] = jsonOfEach(how.positions);
}
void add(Json& object, const MoveAlongNormal& how) {
  object["along_normal_mm"] = how.distance;
}

void add(Json& object, const MovePoints& c) {
  object["points"] = jsonOf(c.points);
  std::visit([&](const auto& how) { add(object, how); }, c.how);
  add(object, c.reach);
}

void add(Json& object, const ScalePoints& c) {
  object["points"] = jsonOf(c.points);
  object["factors"] = jsonOf(c.factors);
  addIf(object, "center_mm", c.center);
  add(object, c.reach);
}

void add(Json& object, const RotatePoints& c) {
  object["points"] = jsonOf(c.points);
  object["axis"] = jsonOf(c.axis);
  object["angle_deg"] = c.angleDegrees;
  addIf(object, "center_mm", c.center);
  add(object, c.reach);
}

void add(Json& object, const AlignPoints& c) {
  object["points"] = jsonOf(c.points);
  addIf(object, "normal", c.normal);
  addIf(object, "offset_mm", c.offset);
}

template <class OneDirection>
void addDirection(Json& object, const OneDirection& c) {
  object["patch"] = c.patch;
  object["direction"] = c.direction == 0 ? "u" : "v";
}

void add(Json& object, const InsertKnot& c) {
  addDirection(object, c);
  object["at"] = c.at;
  object["times"] = c.times;
}

void add(Json& object, const RemoveKnot& c) {
  addDirection(object, c);
  object["at"] = c.at;
  object["times"] = c.times;
  object["tolerance_mm"] = c.tolerance;
}

void add(Json& object, const ElevateDegree& c) {
  addDirection(object, c);
  object["degree"] = c.degree;
}

void add(Json& object, const Translation& how) {
  object["translate_mm"] = jsonOf(how.vector);
}
void add(Json& object, const Rotation& how) {
  object["rotate"] = {{"axis", jsonOf(how.axis)},
                      {"angle_deg", how.angleDegrees},
                      {"center_mm", jsonOf(how.center)}};
}
void add(Json& object, const Scaling& how) {
  object["scale"] = {{"factors", jsonOf(how.factors)}, {"center_mm", jsonOf(how.center)}};
}
void add(Json& object, const MirrorPlane& how) {
  object["mirror"] = jsonOf(how);
}

void add(Json& object, const TransformSolid& c) {
  std::visit([&](const auto& how) { add(object, how); }, c.how);
}
void add(Json& object, const MakePrimitive& c) {
  object["primitive"] = jsonOf(c.primitive);
}
void add(Json& object, const SetEdge& c) {
  object["patch"] = c.patch;
  object["side"] = sideKey(c.side);
  object["smooth"] = c.smooth;
}
void add(Json& object, const AddSupport& c) {
  object["support"] = jsonOf(c.support);
}
void add(Json& object, const SetSupport& c) {
  object["name"] = c.name;
  object["support"] = jsonOf(c.support);
}
void add(Json& object, const TakeOverlap& c) {
  object["name"] = c.name;
  object["from"] = c.from;
  if (c.gap > 0.0) object["gap_mm"] = c.gap;
}
void add(Json& object, const AddLoad& c) {
  object["load"] = jsonOf(c.load);
}
void add(Json& object, const SetLoad& c) {
  object["name"] = c.name;
  object["load"] = jsonOf(c.load);
}
void add(Json& object, const AddTouch& c) {
  object["touch"] = jsonOf(c.touch);
}
void add(Json& object, const SetTouch& c) {
  object["name"] = c.name;
  object["touch"] = jsonOf(c.touch);
}
void add(Json& object, const AddMeasurement& c) {
  object["measurement"] = jsonOf(c.measurement);
}
void add(Json& object, const SetMeasurement& c) {
  object["name"] = c.name;
  object["measurement"] = jsonOf(c.measurement);
}
void add(Json& object, const SetMaterial& c) {
  object["material"] = jsonOf(c.material);
}
void add(Json& object, const SetMesh& c) {
  object["mesh"] = jsonOf(c.mesh);
}
void add(Json& object, const SetDesign& c) {
  if (c.design) object["design"] = jsonOf(*c.design);
}
void add(Json& object, const RenamePatch& c) {
  object["patch"] = c.patch;
  object["name"] = c.name;
}
/// Commands with a name only: RenameProject and those that remove.
template <class Named>
void add(Json& object, const Named& c) {
  object["name"] = c.name;
}

Json jsonOf(const Command& command) {
  Json object{{"command", kCommandNames[command.index()]}};
  std::visit([&](const auto& one) { add(object, one); }, command);
  return object;
}

}  // namespace

std::string toJson(const PointSelection& selection) {
  return jsonText(jsonOf(selection));
}

std::string toJson(const Command& command) {
  return jsonText(jsonOf(command));
}

std::string toJson(const std::vector<Command>& commands) {
  Json list = Json::array();
  for (const Command& command : commands) list.push_back(jsonOf(command));
  return jsonText({{"commands", std::move(list)}}, {"", "commands"}) + "\n";
}

}  // namespace palpa::modeling

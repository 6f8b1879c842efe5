#include <array>

#include "modeling/project/json_values.h"

// Selections of control points and mirror planes as JSON, shared by commands and project files.
namespace palpa::modeling {

using nlohmann::json;

namespace {

std::optional<double> limitIf(const json& object, const char* key) {
  if (!object.contains(key)) return std::nullopt;
  return object[key].get<double>();
}

std::vector<PointSelection> selectionsFrom(const json& list) {
  std::vector<PointSelection> selections;
  for (const json& one : list) selections.push_back(selectionFrom(one));
  return selections;
}

PointSelection::Part partFrom(const json& value) {
  const auto only = value.items().begin();
  const std::string& key = only.key();
  const json& what = only.value();
  if (key == "patches") return PatchPoints{what};
  if (key == "edge") return SidePoints{what["patch"], sideFrom(what["side"])};
  if (key == "net") {
    NetPoints part{what["patch"], {}};
    for (int direction = 0; direction < 2; ++direction)
      if (const json& row = what["row"][direction]; row.is_number()) part.at[direction] = row;
    return part;
  }
  if (key == "half_space")
    return SlabPoints{vectorFrom(what["normal"]), limitIf(what, "above_mm"),
                      limitIf(what, "below_mm")};
  if (key == "box_mm") return BoxPoints{vectorFrom(what[0]), vectorFrom(what[1])};
  if (key == "sphere_mm") return BallPoints{vectorFrom(what["center"]), what["radius"]};
  if (key == "all_of") return AllOf{selectionsFrom(what)};
  return NoneOf{selectionsFrom(what)};
}

struct PartJson {
  Json operator()(const PointIndices& part) const { return part.indices; }
  Json operator()(const PatchPoints& part) const { return {{"patches", part.patches}}; }
  Json operator()(const SidePoints& part) const {
    return {{"edge", {{"patch", part.patch}, {"side", sideKey(part.side)}}}};
  }
  Json operator()(const NetPoints& part) const {
    Json row = Json::array();
    for (const std::optional<int>& at : part.at) row.push_back(at ? Json(*at) : Json("all"));
    return {{"net", {{"patch", part.patch}, {"row", std::move(row)}}}};
  }
  Json operator()(const SlabPoints& part) const {
    Json slab{{"normal", jsonOf(part.normal)}};
    if (part.above) slab["above_mm"] = *part.above;
    if (part.below) slab["below_mm"] = *part.below;
    return {{"half_space", std::move(slab)}};
  }
  Json operator()(const BoxPoints& part) const {
    return {{"box_mm", jsonOfEach(std::array{part.low, part.high})}};
  }
  Json operator()(const BallPoints& part) const {
    return {{"sphere_mm", {{"center", jsonOf(part.center)}, {"radius", part.radius}}}};
  }
  Json operator()(const AllOf& part) const { return {{"all_of", list(part)}}; }
  Json operator()(const NoneOf& part) const { return {{"none_of", list(part)}}; }

  template <class Selections>
  static Json list(const Selections& part) {
    Json list = Json::array();
    for (const PointSelection& one : part.selections) list.push_back(jsonOf(one));
    return list;
  }
};

}  // namespace

PointSelection selectionFrom(const json& value) {
  PointSelection selection;
  if (value.is_object()) return {{partFrom(value)}};
  PointIndices indices;
  for (const json& one : value) {
    if (one.is_number())
      indices.indices.push_back(one);
    else if (one.is_array())
      selection.parts.push_back(PointIndices{one});
    else
      selection.parts.push_back(partFrom(one));
  }
  if (!indices.indices.empty()) selection.parts.insert(selection.parts.begin(), indices);
  return selection;
}

Json jsonOf(const PointSelection& selection) {
  if (selection.parts.size() == 1) return std::visit(PartJson(), selection.parts.front());
  Json parts = Json::array();
  for (const auto& part : selection.parts) parts.push_back(std::visit(PartJson(), part));
  return parts;
}

MirrorPlane planeFrom(const json& value) {
  return {vectorFrom(value["point_mm"]), vectorFrom(value["normal"])};
}

Json jsonOf(const MirrorPlane& plane) {
  return {{"point_mm", jsonOf(plane.point)}, {"normal", jsonOf(plane.normal)}};
}

}  // namespace palpa::modeling

#include "modeling/project/json_values.h"

// Settings of the search for a shape as JSON. Values that equal the default are left out.
namespace palpa::modeling {

using nlohmann::json;

namespace {

DesignTarget targetFrom(const json& value) {
  DesignTarget target;
  target.touch = value["touch"];
  if (value.contains("force_N")) {
    target.kind = DesignTarget::Kind::kForce;
    target.value = value["force_N"];
  } else {
    target.value = value["stiffness_N_per_mm"];
  }
  if (value.contains("depth_mm")) target.depth = value["depth_mm"].get<double>();
  target.weight = value.value("weight", 1.0);
  return target;
}

Json jsonOf(const DesignTarget& target) {
  Json object{{"touch", target.touch}};
  object[target.kind == DesignTarget::Kind::kForce ? "force_N" : "stiffness_N_per_mm"] =
      target.value;
  if (target.depth) object["depth_mm"] = *target.depth;
  if (target.weight != 1.0) object["weight"] = target.weight;
  return object;
}

}  // namespace

Design designFrom(const json& value) {
  Design design;
  for (const json& one : value["targets"]) design.targets.push_back(targetFrom(one));
  if (value.contains("points")) design.points = selectionFrom(value["points"]);
  if (value.contains("along")) {
    const json& along = value["along"];
    if (along.is_array()) {
      design.along = Design::Along::kDirection;
      design.direction = vectorFrom(along);
    } else if (along == "any") {
      design.along = Design::Along::kAny;
    }
  }
  if (value.contains("largest_movement_mm"))
    design.largestMovement = value["largest_movement_mm"].get<double>();
  for (const json& one : value.value("mirrors", json::array()))
    design.mirrors.push_back(planeFrom(one));
  if (value.contains("volume")) design.volume = *volumeNamed(value["volume"].get<std::string>());
  if (value.contains("smallest_thickness_mm"))
    design.smallestThickness = value["smallest_thickness_mm"].get<double>();
  design.smoothness = value.value("smoothness", design.smoothness);
  design.tolerance = value.value("tolerance", design.tolerance);
  design.steps = value.value("steps", design.steps);
  return design;
}

Json jsonOf(const Design& design) {
  const Design usual;
  Json targets = Json::array();
  for (const DesignTarget& target : design.targets) targets.push_back(jsonOf(target));
  Json object{{"targets", std::move(targets)}};
  if (design.points) object["points"] = jsonOf(*design.points);
  if (design.along == Design::Along::kAny) object["along"] = "any";
  if (design.along == Design::Along::kDirection) object["along"] = jsonOf(design.direction);
  if (design.largestMovement) object["largest_movement_mm"] = *design.largestMovement;
  if (!design.mirrors.empty()) object["mirrors"] = jsonOfEach(design.mirrors);
  if (design.volume != usual.volume)
    object["volume"] = kVolumeNames[static_cast<std::size_t>(design.volume)];
  if (design.smallestThickness) object["smallest_thickness_mm"] = *design.smallestThickness;
  if (design.smoothness != usual.smoothness) object["smoothness"] = design.smoothness;
  if (design.tolerance != usual.tolerance) object["tolerance"] = design.tolerance;
  if (design.steps != usual.steps) object["steps"] = design.steps;
  return object;
}

}  // namespace palpa::modeling

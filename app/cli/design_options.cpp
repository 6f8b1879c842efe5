#include "app/cli/design_options.h"

#include <string_view>
#include <variant>

#include "app/cli/errors.h"
#include "app/cli/values.h"

namespace palpa::cli {
namespace {

using modeling::Design;
using modeling::DesignTarget;

/// Removes the ending, and spaces before it, if the text has it.
bool takeEnding(std::string& text, std::string_view ending) {
  if (!text.ends_with(ending)) return false;
  text.erase(text.size() - ending.size());
  while (text.ends_with(' ')) text.pop_back();
  return true;
}

/// "NAME=0.8", "NAME=0.8N/mm", "NAME=1N", "NAME=1N@3mm"; the name may contain "=".
DesignTarget targetFrom(const std::string& text) {
  constexpr const char* kOption = "--target";
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError(
        "--target: expected NAME=STIFFNESS (N/mm), NAME=FORCE N or NAME=FORCE N@DEPTH (mm), found "
        "'" +
        text + "'");
  DesignTarget target;
  target.touch = text.substr(0, equals);
  std::string value = text.substr(equals + 1);
  if (const auto at = value.rfind('@'); at != std::string::npos) {
    std::string depth = value.substr(at + 1);
    takeEnding(depth, "mm");
    target.depth = parsePositive(kOption, depth);
    value.erase(at);
    while (value.ends_with(' ')) value.pop_back();
    if (!value.ends_with('N'))
      throw UsageError("--target: a depth belongs to a force, as in 'press=1N@3mm'; found '" +
                       text + "'");
  }
  if (!takeEnding(value, "N/mm") && takeEnding(value, "N"))
    target.kind = DesignTarget::Kind::kForce;
  target.value = parsePositive(kOption, value);
  return target;
}

std::vector<int> numbersFrom(const std::string& text) {
  std::vector<int> numbers;
  std::string_view rest = text;
  while (true) {
    const auto comma = rest.find(',');
    const std::string one(rest.substr(0, comma));
    if (one.empty() || one.find_first_not_of("0123456789") != std::string::npos || one.size() > 9)
      throw UsageError("--points: expected numbers of control points N,N,…, found '" + text + "'");
    numbers.push_back(std::stoi(one));
    if (comma == std::string_view::npos) return numbers;
    rest.remove_prefix(comma + 1);
  }
}

modeling::MirrorPlane mirrorFrom(const std::string& text) {
  const auto equals = text.find('=');
  const std::string axis = text.substr(0, equals);
  if (axis != "x" && axis != "y" && axis != "z")
    throw UsageError("--mirror: expected x, y, z or x=OFFSET (mm), found '" + text + "'");
  const double offset =
      equals == std::string::npos ? 0 : parseNumber("--mirror", text.substr(equals + 1));
  const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis[0] - 'x');
  return {offset * normal, normal};
}

/// Patches that supports fix as a whole.
void addFixedPatches(const modeling::Project& project, std::vector<std::string>& patches) {
  for (const modeling::Support& support : project.supports)
    for (const modeling::RegionPart& part : support.where.parts)
      if (const auto* set = std::get_if<modeling::PatchSet>(&part))
        patches.insert(patches.end(), set->patches.begin(), set->patches.end());
}

}  // namespace

void DesignOptions::declare(CLI::App& options) {
  options
      .add_option(
          "--target", targets_,
          "What a touch of the project should feel like, by its name: NAME=STIFFNESS (N/mm), "
          "NAME=FORCE N at its own depth, or NAME=FORCE N@DEPTH mm. Repeat it for several "
          "targets; without it the targets of the project's design are used")
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options
      .add_option("--move", move_,
                  "Patch whose control points may move; repeat it. By default all outside "
                  "patches that supports fix")
      ->type_name("PATCH")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options.add_option("--stay", stay_, "Patch whose control points must stay; repeat it")
      ->type_name("PATCH")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options.add_option("--points", points_, "Control points that may move, by number")
      ->type_name("N,N,…");
  options
      .add_option("--along", along_,
                  "Directions of motion: normal (default), any, or a vector x,y,z")
      ->type_name("HOW");
  options
      .add_option(
          "--largest-movement", largestMovement_,
          "Largest movement of a control point (mm); default: a tenth of the body's diagonal")
      ->type_name("MM");
  options
      .add_option("--mirror", mirrors_,
                  "Plane about which the body is and stays symmetric: x, y, z or x=OFFSET (mm); "
                  "repeat it, up to three")
      ->type_name("PLANE")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  options
      .add_option("--volume", volume_,
                  "Volume, and mass: free (default), kept, not_larger, minimised")
      ->type_name("RULE");
  options
      .add_option("--smallest-thickness", smallestThickness_, "Smallest thickness of walls (mm)")
      ->type_name("MM");
  options
      .add_option("--smoothness", smoothness_,
                  "0 lets each control point move alone, more smooths the change over more "
                  "neighbours; default 1")
      ->type_name("NUMBER");
  options
      .add_option("--tolerance", tolerance_,
                  "Relative error of a target that is good enough; default 0.005")
      ->type_name("NUMBER");
  options.add_option("--max-steps", steps_, "Largest number of steps; default 20")->type_name("N");
}

Design DesignOptions::design(const modeling::Project& project) const {
  Design design = project.design.value_or(Design{});
  if (!targets_.empty()) design.targets.clear();
  for (const std::string& text : targets_) design.targets.push_back(targetFrom(text));
  if (!points_.empty() || !move_.empty()) {
    modeling::PointSelection points;
    if (!points_.empty()) points.parts.push_back(modeling::PointIndices{numbersFrom(points_)});
    if (!move_.empty()) points.parts.push_back(modeling::PatchPoints{move_});
    design.points = std::move(points);
  }
  if (!stay_.empty()) {
    std::vector<std::string> stay = stay_;
    if (!design.points) addFixedPatches(project, stay);
    const modeling::PointSelection others{
        {modeling::NoneOf{{modeling::PointSelection{{modeling::PatchPoints{stay}}}}}}};
    design.points =
        design.points
            ? modeling::PointSelection{{modeling::AllOf{{*std::move(design.points), others}}}}
            : others;
  }
  if (along_ == "normal" || along_ == "any") {
    design.along = along_ == "any" ? Design::Along::kAny : Design::Along::kNormal;
  } else if (!along_.empty()) {
    design.along = Design::Along::kDirection;
    design.direction = parseVector("--along", along_);
  }
  if (!largestMovement_.empty())
    design.largestMovement = parsePositive("--largest-movement", largestMovement_);
  if (!mirrors_.empty()) design.mirrors.clear();
  for (const std::string& text : mirrors_) design.mirrors.push_back(mirrorFrom(text));
  if (!volume_.empty()) {
    const auto rule = modeling::volumeNamed(volume_);
    if (!rule)
      throw UsageError("--volume: expected free, kept, not_larger or minimised, found '" + volume_ +
                       "'");
    design.volume = *rule;
  }
  if (!smallestThickness_.empty())
    design.smallestThickness = parsePositive("--smallest-thickness", smallestThickness_);
  if (!smoothness_.empty()) design.smoothness = parseNumber("--smoothness", smoothness_);
  if (!tolerance_.empty()) design.tolerance = parsePositive("--tolerance", tolerance_);
  if (!steps_.empty()) design.steps = parseCount("--max-steps", steps_, Design::kMaxSteps);
  return design;
}

}  // namespace palpa::cli

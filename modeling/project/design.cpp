#include "modeling/project/design.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"

namespace palpa::modeling {
namespace {

void requireRange(double value, double low, double high, const std::string& path) {
  if (!(value >= low && value <= high))
    throw ModelingError(path + ": " + numberText(value) + " is outside the range " +
                        numberText(low) + " … " + numberText(high));
}

std::string quotedList(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

void checkTarget(const DesignTarget& target, const std::vector<std::string>& touchNames,
                 const std::string& path) {
  if (std::find(touchNames.begin(), touchNames.end(), target.touch) == touchNames.end())
    throw ModelingError(path + ".touch: no touch is named \"" + target.touch + "\"; " +
                        (touchNames.empty() ? std::string("the project has no touches")
                                            : "the project has " + quotedList(touchNames)));
  const bool isForce = target.kind == DesignTarget::Kind::kForce;
  requirePositive(target.value, path + (isForce ? ".force_N" : ".stiffness_N_per_mm"));
  if (target.depth) {
    if (!isForce) throw ModelingError(path + ".depth_mm: belongs to a force, not to a stiffness");
    requirePositive(*target.depth, path + ".depth_mm");
  }
  requirePositive(target.weight, path + ".weight");
}

}  // namespace

std::optional<Design::Volume> volumeNamed(std::string_view name) {
  const auto found = std::find(kVolumeNames.begin(), kVolumeNames.end(), name);
  if (found == kVolumeNames.end()) return std::nullopt;
  return static_cast<Design::Volume>(found - kVolumeNames.begin());
}

void checkDesign(const Design& design, const std::vector<std::string>& touchNames,
                 const std::string& path) {
  for (std::size_t i = 0; i < design.targets.size(); ++i)
    checkTarget(design.targets[i], touchNames, path + ".targets[" + std::to_string(i) + "]");
  if (design.along == Design::Along::kDirection)
    requireDirection(design.direction, path + ".along");
  if (design.largestMovement)
    requirePositive(*design.largestMovement, path + ".largest_movement_mm");
  if (design.mirrors.size() > Design::kMaxMirrors)
    throw ModelingError(path + ".mirrors: found " + std::to_string(design.mirrors.size()) +
                        " planes, expected at most " + std::to_string(Design::kMaxMirrors));
  for (std::size_t i = 0; i < design.mirrors.size(); ++i) {
    const std::string at = path + ".mirrors[" + std::to_string(i) + "]";
    requireFinite(design.mirrors[i].point, at + ".point_mm");
    requireDirection(design.mirrors[i].normal, at + ".normal");
  }
  if (design.smallestThickness)
    requirePositive(*design.smallestThickness, path + ".smallest_thickness_mm");
  requireRange(design.smoothness, 0, Design::kMaxSmoothness, path + ".smoothness");
  requireRange(design.tolerance, Design::kMinTolerance, Design::kMaxTolerance, path + ".tolerance");
  requireRange(design.steps, 1, Design::kMaxSteps, path + ".steps");
}

void renamePatch(PointSelection& selection, const std::string& from, const std::string& to) {
  const auto rename = [&](std::string& name) {
    if (name == from) name = to;
  };
  for (PointSelection::Part& part : selection.parts)
    std::visit(
        [&](auto& one) {
          if constexpr (requires { one.patch; }) rename(one.patch);
          if constexpr (requires { one.patches; })
            for (std::string& name : one.patches) rename(name);
          if constexpr (requires { one.selections; })
            for (PointSelection& inner : one.selections) renamePatch(inner, from, to);
        },
        part);
}

bool selectsByPosition(const PointSelection& selection) {
  return std::any_of(
      selection.parts.begin(), selection.parts.end(), [](const PointSelection::Part& part) {
        return std::visit(
            [](const auto& one) {
              using Part = std::decay_t<decltype(one)>;
              if constexpr (requires { one.selections; })
                return std::any_of(one.selections.begin(), one.selections.end(), selectsByPosition);
              return std::is_same_v<Part, SlabPoints> || std::is_same_v<Part, BoxPoints> ||
                     std::is_same_v<Part, BallPoints>;
            },
            part);
      });
}

}  // namespace palpa::modeling

#include "modeling/body/region.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

void checkPart(const PatchSet& part, const Body& body, const std::set<std::string>& names,
               const std::string& path) {
  if (part.patches.empty()) throw ModelingError(path + ".patches: is empty");
  for (std::size_t i = 0; i < part.patches.size(); ++i)
    if (!names.contains(part.patches[i]))
      throw ModelingError(path + ".patches[" + std::to_string(i) + "]: no patch is named \"" +
                          part.patches[i] + "\"; the body has " + quotedPatchNames(body));
}

void checkPart(const HalfSpace& part, const Body&, const std::set<std::string>&,
               const std::string& path) {
  if (!part.normal.allFinite() || part.normal.norm() < 1e-9)
    throw ModelingError(path + ".half_space.normal: must be finite and not zero");
  if (!std::isfinite(part.below))
    throw ModelingError(path + ".half_space.below_mm: must be finite");
}

void checkPart(const Stroke& part, const Body&, const std::set<std::string>&,
               const std::string& path) {
  const std::string points = path + ".stroke.points_mm";
  if (part.points.empty()) throw ModelingError(points + ": is empty");
  if (part.points.size() > Stroke::kMaxPoints)
    throw ModelingError(points + ": has " + std::to_string(part.points.size()) +
                            " points; at most " + std::to_string(Stroke::kMaxPoints) +
                            " are possible",
                        ModelingError::Kind::kTooLarge);
  for (std::size_t i = 0; i < part.points.size(); ++i)
    if (!part.points[i].allFinite())
      throw ModelingError(points + "[" + std::to_string(i) + "]: must be finite");
  if (!std::isfinite(part.radius) || part.radius <= 0.0)
    throw ModelingError(path + ".stroke.radius_mm: " + numberText(part.radius) +
                        " must be finite and greater than 0");
}

}  // namespace

Eigen::Vector3d Stroke::nearest(const Eigen::Vector3d& x) const {
  Eigen::Vector3d best = points.front();
  double least = (x - best).squaredNorm();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector3d along = points[i] - points[i - 1];
    const double length = along.squaredNorm();
    const double part =
        length > 0.0 ? std::clamp(along.dot(x - points[i - 1]) / length, 0.0, 1.0) : 0.0;
    const Eigen::Vector3d candidate = points[i - 1] + part * along;
    if (const double distance = (x - candidate).squaredNorm(); distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

double Stroke::value(const Eigen::Vector3d& x) const {
  return (x - nearest(x)).norm() - radius;
}

void checkRegion(const Region& region, const Body& body, const std::string& path) {
  const std::vector<std::string> names = patchNames(body);
  checkRegion(region, body, {names.begin(), names.end()}, path);
}

void checkRegion(const Region& region, const Body& body, const std::set<std::string>& names,
                 const std::string& path) {
  if (region.parts.empty()) throw ModelingError(path + ": is empty");
  // Exceptions follow the parts in the list of the file.
  const bool isList = region.parts.size() > 1 || !region.except.empty();
  for (std::size_t i = 0; i < region.parts.size(); ++i) {
    const std::string partPath = isList ? path + "[" + std::to_string(i) + "]" : path;
    std::visit([&](const auto& part) { checkPart(part, body, names, partPath); }, region.parts[i]);
  }
  const std::string exceptPath = path + "[" + std::to_string(region.parts.size()) + "].except";
  for (std::size_t i = 0; i < region.except.size(); ++i)
    std::visit(
        [&](const auto& part) {
          checkPart(part, body, names, exceptPath + "[" + std::to_string(i) + "]");
        },
        region.except[i]);
}

std::vector<bool> namedPatches(const std::vector<RegionPart>& parts, const Body& body) {
  std::vector<bool> isNamed(patchNames(body).size(), false);
  for (const RegionPart& part : parts)
    if (const auto* set = std::get_if<PatchSet>(&part))
      for (const std::string& name : set->patches)
        if (const auto patch = findPatch(body, name)) isNamed[*patch] = true;
  return isNamed;
}

bool isInSpace(const std::vector<RegionPart>& parts, const Eigen::Vector3d& x) {
  return std::any_of(parts.begin(), parts.end(), [&](const RegionPart& part) {
    const auto* half = std::get_if<HalfSpace>(&part);
    const auto* stroke = std::get_if<Stroke>(&part);
    return (half && half->value(x) < 0.0) || (stroke && stroke->value(x) < 0.0);
  });
}

std::vector<double> regionField(const Region& region, const Body& body,
                                std::span<const Eigen::Vector3d> positions,
                                std::span<const int> patchOfPosition) {
  if (positions.size() != patchOfPosition.size())
    throw std::invalid_argument("regionField: positions and patches differ in number");
  const auto [low, high] = boundingBox(body);
  const double cap = kRegionFieldCap * (high - low).norm();
  const auto distances = [&](const std::vector<RegionPart>& parts) {
    std::vector<double> field(positions.size(), cap);
    const std::vector<bool> isNamed = namedPatches(parts, body);
    const auto add = [&](const auto& value) {
      for (std::size_t i = 0; i < positions.size(); ++i)
        field[i] = std::max(-cap, std::min(field[i], value(i)));
    };
    add([&](std::size_t i) { return isNamed[patchOfPosition[i]] ? -cap : cap; });
    for (const RegionPart& part : parts) {
      if (const auto* half = std::get_if<HalfSpace>(&part))
        add([&](std::size_t i) { return half->value(positions[i]) / half->normal.norm(); });
      if (const auto* stroke = std::get_if<Stroke>(&part))
        add([&](std::size_t i) { return stroke->value(positions[i]); });
    }
    return field;
  };
  std::vector<double> field = distances(region.parts);
  if (region.except.empty()) return field;
  const std::vector<double> removed = distances(region.except);
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::max(field[i], -removed[i]);
  return field;
}

}  // namespace palpa::modeling

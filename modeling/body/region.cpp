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
  for (std::size_t i = 0; i < region.parts.size(); ++i) {
    const std::string partPath =
        region.parts.size() == 1 ? path : path + "[" + std::to_string(i) + "]";
    std::visit([&](const auto& part) { checkPart(part, body, names, partPath); }, region.parts[i]);
  }
}

std::vector<double> regionField(const Region& region, const Body& body,
                                std::span<const Eigen::Vector3d> positions,
                                std::span<const int> patchOfPosition) {
  if (positions.size() != patchOfPosition.size())
    throw std::invalid_argument("regionField: positions and patches differ in number");
  const auto [low, high] = boundingBox(body);
  const double cap = kRegionFieldCap * (high - low).norm();
  std::vector<double> field(positions.size(), cap);
  const auto add = [&](const auto& value) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      field[i] = std::max(-cap, std::min(field[i], value(i)));
  };
  for (const RegionPart& part : region.parts) {
    if (const auto* half = std::get_if<HalfSpace>(&part))
      add([&](std::size_t i) { return half->value(positions[i]) / half->normal.norm(); });
    if (const auto* stroke = std::get_if<Stroke>(&part))
      add([&](std::size_t i) { return stroke->value(positions[i]); });
    if (const auto* set = std::get_if<PatchSet>(&part)) {
      std::vector<bool> isNamed(patchNames(body).size(), false);
      for (const std::string& name : set->patches)
        if (const auto patch = findPatch(body, name)) isNamed[*patch] = true;
      add([&](std::size_t i) { return isNamed[patchOfPosition[i]] ? -cap : cap; });
    }
  }
  return field;
}

}  // namespace palpa::modeling

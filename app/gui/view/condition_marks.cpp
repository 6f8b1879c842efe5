#include "app/gui/view/condition_marks.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace palpa::gui {
namespace {

/// True for each patch that the region names.
std::vector<bool> namedPatches(const modeling::Region& region, const modeling::Body& body) {
  std::vector<bool> result(modeling::patchNames(body).size(), false);
  for (const modeling::RegionPart& part : region.parts)
    if (const auto* set = std::get_if<modeling::PatchSet>(&part))
      for (const std::string& name : set->patches)
        if (const auto patch = modeling::findPatch(body, name)) result[*patch] = true;
  return result;
}

/// True if one of the region's half-spaces or strokes contains the point.
bool reaches(const modeling::Region& region, const Eigen::Vector3d& point) {
  for (const modeling::RegionPart& part : region.parts) {
    const auto* half = std::get_if<modeling::HalfSpace>(&part);
    const auto* stroke = std::get_if<modeling::Stroke>(&part);
    if ((half && half->value(point) < 0.0) || (stroke && stroke->value(point) < 0.0)) return true;
  }
  return false;
}

Eigen::Vector3d areaVector(const ShownSurface& surface, std::size_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const auto& p = surface.positions;
  return 0.5 * (p[b] - p[a]).cross(p[c] - p[a]);
}

view::ForceArrow arrow(const std::string& label, const Eigen::Vector3d& at,
                       const Eigen::Vector3d& direction, view::ForceArrow::Anchor anchor) {
  view::ForceArrow result;
  result.at = at;
  result.force = direction.norm() > 0.0 ? Eigen::Vector3d(direction.normalized()) : direction;
  result.anchor = anchor;
  result.label = label;
  return result;
}

/// Strength along the arrow, MPa. A pressure keeps its sign: suction is negative.
double strengthOf(const modeling::Load& load) {
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) return pressure->pressure;
  if (const auto* bump = std::get_if<modeling::Bump>(&load.what))
    return std::abs(bump->peak) * bump->direction.norm();
  return std::get<modeling::UniformTraction>(load.what).traction.norm();
}

/// "Weight: 2.5 kPa".
std::string labelOf(const modeling::Load& load, const ShownUnits& units) {
  constexpr int kDigits = 3;
  return load.name + ": " +
         shown(strengthOf(load), Quantity::kStress, units, kDigits).toStdString();
}

}  // namespace

std::optional<SurfacePlace> regionMiddle(const modeling::Region& region, const modeling::Body& body,
                                         const ShownSurface& surface) {
  const std::vector<bool> isNamed = namedPatches(region, body);
  std::vector<std::size_t> inside;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Eigen::Vector3d middle = surface.middle(t);
    if (!isNamed[surface.patchOfTriangle[t]] && !reaches(region, middle)) continue;
    const double size = areaVector(surface, t).norm();
    inside.push_back(t);
    centre += size * middle;
    area += size;
  }
  if (area <= 0.0) return std::nullopt;
  centre /= area;
  std::size_t best = inside.front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t : inside) {
    const double distance = (surface.middle(t) - centre).squaredNorm();
    if (distance < least) {
      least = distance;
      best = t;
    }
  }
  return SurfacePlace{surface.patchOfTriangle[best], std::nullopt, surface.middle(best),
                      areaVector(surface, best).normalized()};
}

std::vector<view::ForceArrow> loadArrows(const modeling::Project& project,
                                         const ShownSurface& surface, const ShownUnits& units) {
  using Anchor = view::ForceArrow::Anchor;
  std::vector<view::ForceArrow> arrows;
  for (const modeling::Load& load : project.loads) {
    if (const auto* bump = std::get_if<modeling::Bump>(&load.what)) {
      const double sign = bump->peak < 0.0 ? -1.0 : bump->peak > 0.0 ? 1.0 : 0.0;
      arrows.push_back(
          arrow(labelOf(load, units), bump->center, sign * bump->direction, Anchor::kTip));
      continue;
    }
    const auto place = regionMiddle(*modeling::regionOf(load), project.body, surface);
    if (!place) continue;
    if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) {
      const double sign = pressure->pressure < 0.0 ? -1.0 : pressure->pressure > 0.0 ? 1.0 : 0.0;
      arrows.push_back(arrow(labelOf(load, units), place->position, -sign * place->normal,
                             sign < 0.0 ? Anchor::kTail : Anchor::kTip));
    } else {
      const auto& traction = std::get<modeling::UniformTraction>(load.what).traction;
      arrows.push_back(arrow(labelOf(load, units), place->position, traction,
                             traction.dot(place->normal) < 0.0 ? Anchor::kTip : Anchor::kTail));
    }
  }
  return arrows;
}

std::vector<view::TouchMarker> touchMarkers(const modeling::Project& project,
                                            const Selection& selection) {
  std::vector<view::TouchMarker> markers;
  for (const modeling::Touch& touch : project.touches) {
    const Selection::Named named{Selection::Kind::kTouch, touch.name};
    markers.push_back({touch.at, touch.vector, touch.name, selection.named == named});
  }
  return markers;
}

}  // namespace palpa::gui

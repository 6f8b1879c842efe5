#include "app/gui/view/condition_marks.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "app/gui/document/load_kinds.h"
#include "app/view/scene/arrows.h"

namespace palpa::gui {
namespace {

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

/// Tells for each triangle whether its middle lies in the region.
auto insideTest(const modeling::Region& region, const modeling::Body& body,
                const ShownSurface& surface) {
  const auto isIn = [&](const std::vector<modeling::RegionPart>& parts) {
    return [&parts, isNamed = modeling::namedPatches(parts, body)](int patch,
                                                                   const Eigen::Vector3d& point) {
      return isNamed[patch] || modeling::isInSpace(parts, point);
    };
  };
  const auto isInside = isIn(region.parts), isExcepted = isIn(region.except);
  return [=](std::size_t triangle) {
    const Eigen::Vector3d middle = surface.middle(triangle);
    const int patch = surface.patchOfTriangle[triangle];
    return isInside(patch, middle) && !isExcepted(patch, middle);
  };
}

/// "Weight: 2.5 kPa".
std::string labelOf(const modeling::Load& load, const ShownUnits& units) {
  return load.name + ": " + strengthText(load, units).toStdString();
}

double signOf(double value) {
  return value < 0.0 ? -1.0 : value > 0.0 ? 1.0 : 0.0;
}

}  // namespace

std::optional<SurfacePlace> regionMiddle(const modeling::Region& region, const modeling::Body& body,
                                         const ShownSurface& surface) {
  const auto isInside = insideTest(region, body, surface);
  std::vector<std::size_t> inside;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!isInside(t)) continue;
    const Eigen::Vector3d middle = surface.middle(t);
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

double regionArea(const modeling::Region& region, const modeling::Body& body,
                  const ShownSurface& surface) {
  const auto isInside = insideTest(region, body, surface);
  double area = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (isInside(t)) area += areaVector(surface, t).norm();
  return area;
}

std::vector<view::ForceArrow> loadArrows(const modeling::Project& project,
                                         const ShownSurface& surface, const ShownUnits& units) {
  using Anchor = view::ForceArrow::Anchor;
  std::vector<view::ForceArrow> arrows;
  for (const modeling::Load& load : project.loads) {
    const std::string label = labelOf(load, units);
    if (const auto* bump = std::get_if<modeling::Bump>(&load.what)) {
      arrows.push_back(
          arrow(label, bump->center, signOf(bump->peak) * bump->direction, Anchor::kTip));
      continue;
    }
    if (const auto* gravity = std::get_if<modeling::Gravity>(&load.what)) {
      arrows.push_back(arrow(label, view::volumeCentre(surface.positions, surface.triangles),
                             gravity->accelerationMPerS2, Anchor::kTail));
      arrows.back().kind = view::ForceArrow::Kind::kWeight;
      continue;
    }
    const auto place = regionMiddle(*modeling::regionOf(load), project.body, surface);
    if (!place) continue;
    if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) {
      const double sign = signOf(pressure->pressure);
      arrows.push_back(arrow(label, place->position, -sign * place->normal,
                             sign < 0.0 ? Anchor::kTail : Anchor::kTip));
    } else {
      const Eigen::Vector3d& direction = *vectorOf(load);
      arrows.push_back(arrow(label, place->position, direction,
                             direction.dot(place->normal) < 0.0 ? Anchor::kTip : Anchor::kTail));
      if (std::holds_alternative<modeling::Moment>(load.what))
        arrows.back().kind = view::ForceArrow::Kind::kMoment;
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

#include "app/gui/view/condition_marks.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "app/gui/base/overloaded.h"

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

/// Strength along the arrow. A pressure keeps its sign: suction is negative.
QString strengthOf(const modeling::Load& load, const ShownUnits& units) {
  constexpr int kDigits = 3;
  const auto stress = [&](double value) { return shown(value, Quantity::kStress, units, kDigits); };
  const auto number = [&](double value, const char* unit) {
    return shown(value, Quantity::kNumber, units, kDigits) + unit;
  };
  return std::visit(
      Overloaded{
          [&](const modeling::Pressure& of) { return stress(of.pressure); },
          [&](const modeling::UniformTraction& of) { return stress(of.traction.norm()); },
          [&](const modeling::Bump& of) { return stress(std::abs(of.peak) * of.direction.norm()); },
          [&](const modeling::TotalForce& of) {
            return shown(of.force.norm(), Quantity::kForce, units, kDigits);
          },
          [&](const modeling::Moment& of) { return number(of.moment.norm(), " N mm"); },
          [&](const modeling::Gravity& of) {
            return number(of.accelerationMPerS2.norm(), " m/s²");
          }},
      load.what);
}

/// "Weight: 2.5 kPa".
std::string labelOf(const modeling::Load& load, const ShownUnits& units) {
  return load.name + ": " + strengthOf(load, units).toStdString();
}

/// Direction of the arrow at a place of the load's region; zero without one.
Eigen::Vector3d directionOf(const modeling::Load& load) {
  return std::visit(
      Overloaded{[](const modeling::UniformTraction& of) { return of.traction; },
                 [](const modeling::TotalForce& of) { return of.force; },
                 [](const modeling::Moment& of) { return of.moment; },
                 [](const auto&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); }},
      load.what);
}

}  // namespace

std::optional<SurfacePlace> regionMiddle(const modeling::Region& region, const modeling::Body& body,
                                         const ShownSurface& surface) {
  const auto isIn = [&](const std::vector<modeling::RegionPart>& parts) {
    return [&parts, isNamed = modeling::namedPatches(parts, body)](int patch,
                                                                   const Eigen::Vector3d& point) {
      return isNamed[patch] || modeling::isInSpace(parts, point);
    };
  };
  const auto isInside = isIn(region.parts), isExcepted = isIn(region.except);
  std::vector<std::size_t> inside;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Eigen::Vector3d middle = surface.middle(t);
    const int patch = surface.patchOfTriangle[t];
    if (!isInside(patch, middle) || isExcepted(patch, middle)) continue;
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
    if (const auto* gravity = std::get_if<modeling::Gravity>(&load.what)) {
      const auto corners = modeling::boundingBox(project.body);
      arrows.push_back(arrow(labelOf(load, units), (corners[0] + corners[1]) / 2,
                             gravity->accelerationMPerS2, Anchor::kTail));
      continue;
    }
    const auto place = regionMiddle(*modeling::regionOf(load), project.body, surface);
    if (!place) continue;
    if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) {
      const double sign = pressure->pressure < 0.0 ? -1.0 : pressure->pressure > 0.0 ? 1.0 : 0.0;
      arrows.push_back(arrow(labelOf(load, units), place->position, -sign * place->normal,
                             sign < 0.0 ? Anchor::kTail : Anchor::kTip));
    } else {
      const Eigen::Vector3d direction = directionOf(load);
      arrows.push_back(arrow(labelOf(load, units), place->position, direction,
                             direction.dot(place->normal) < 0.0 ? Anchor::kTip : Anchor::kTail));
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

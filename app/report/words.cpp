#include "app/report/words.h"

#include "app/report/text.h"

namespace palpa::report {
namespace {

std::string partsText(const std::vector<modeling::RegionPart>& parts) {
  std::string text;
  for (const modeling::RegionPart& part : parts) {
    if (!text.empty()) text += " and ";
    if (const auto* patches = std::get_if<modeling::PatchSet>(&part)) {
      for (std::size_t i = 0; i < patches->patches.size(); ++i) {
        text += (i ? ", " : "") + patches->patches[i];
      }
    } else if (const auto* half = std::get_if<modeling::HalfSpace>(&part)) {
      text += "where " + toText(half->normal) + format(" · x < %.6g mm", half->below);
    } else {
      const auto& stroke = std::get<modeling::Stroke>(part);
      text += format("within %.6g mm of ", stroke.radius) + toText(stroke.points.front());
      if (stroke.points.size() > 1)
        text += format(" and the stroke through %zu more points", stroke.points.size() - 1);
    }
  }
  return text;
}

}  // namespace

std::string regionText(const modeling::Region& region) {
  const std::string text = partsText(region.parts);
  return region.except.empty() ? text : text + ", except " + partsText(region.except);
}

std::string loadText(const modeling::Load& load) {
  if (const auto* pressure = std::get_if<modeling::Pressure>(&load.what)) {
    return format("pressure %.6g MPa on ", pressure->pressure) + regionText(pressure->where);
  }
  if (const auto* traction = std::get_if<modeling::UniformTraction>(&load.what)) {
    return "traction " + toText(traction->traction) + " MPa on " + regionText(traction->where);
  }
  if (const auto* total = std::get_if<modeling::TotalForce>(&load.what)) {
    return "total force " + toText(total->force) + " N on " + regionText(total->where);
  }
  if (const auto* moment = std::get_if<modeling::Moment>(&load.what)) {
    return "moment " + toText(moment->moment) + " N mm on " + regionText(moment->where);
  }
  if (const auto* gravity = std::get_if<modeling::Gravity>(&load.what)) {
    return "gravity " + toText(gravity->accelerationMPerS2) + " m/s²";
  }
  const auto& bump = std::get<modeling::Bump>(load.what);
  return format("bump of %.6g MPa along ", bump.peak) + toText(bump.direction) + " within " +
         format("%.6g mm of ", bump.radius) + toText(bump.center);
}

std::string touchText(const modeling::Touch& touch) {
  const modeling::TouchKindInfo& kind = modeling::infoOf(touch.kind);
  std::string text = kind.name + (" at " + toText(touch.at));
  if (kind.isForce) {
    text += ", " + toText(touch.vector) + " N";
  } else if (!kind.needsVector && touch.vector.isZero(0)) {
    text += ", held in place";
  } else {
    text += ", moved by " + toText(touch.vector) + " mm";
  }
  if (touch.radius) text += format(", radius %.6g mm", *touch.radius);
  if (kind.presses) text += format(", friction %.6g", touch.friction);
  return text;
}

const char* engineName(modeling::Engine engine) {
  if (engine == modeling::Engine::kSplines) return "splines";
  return engine == modeling::Engine::kQuadratic ? "quadratic" : "triangles";
}

}  // namespace palpa::report

#include "app/core/session/new_project.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include "modeling/project/proposed_support.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::app {
namespace {

/// The lowest tenth of the body's height, the limit rounded to three digits.
modeling::Region lowestTenth(const modeling::Solid& solid) {
  constexpr int kSamples = 16;
  const modeling::SurfaceEvaluator surface(solid);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int i = 0; i <= kSamples; ++i)
      for (int j = 0; j <= kSamples; ++j) {
        const auto [uLow, uHigh] = surface.range(patch, 0);
        const auto [vLow, vHigh] = surface.range(patch, 1);
        const double z = surface
                             .position(patch, uLow + (uHigh - uLow) * i / kSamples,
                                       vLow + (vHigh - vLow) * j / kSamples)
                             .z();
        low = std::min(low, z);
        high = std::max(high, z);
      }
  const double limit = low + 0.1 * (high - low);
  // Relative to the height: far from z = 0, three digits of the limit itself could miss the body.
  const double unit = std::pow(10.0, std::floor(std::log10(high - low)) - 2.0);
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", std::round(limit / unit) * unit);
  return modeling::Region::below(Eigen::Vector3d::UnitZ(), std::strtod(text, nullptr));
}

/// True if a body of this shape stands on patches named "bottom".
bool hasFlatBase(const modeling::Primitive& primitive) {
  return std::visit(
      []<class Shape>(const Shape&) {
        return std::is_same_v<Shape, modeling::BoxShape> ||
               std::is_same_v<Shape, modeling::CylinderShape> ||
               std::is_same_v<Shape, modeling::ConeShape> ||
               std::is_same_v<Shape, modeling::ExtrudeShape> ||
               std::is_same_v<Shape, modeling::LoftShape>;
      },
      primitive.shape);
}

modeling::Region baseOf(const modeling::Primitive& primitive, const modeling::Solid& solid) {
  if (!hasFlatBase(primitive)) return lowestTenth(solid);
  std::vector<std::string> names;
  for (const modeling::Patch& patch : solid.patches())
    if (patch.name.rfind("bottom", 0) == 0) names.push_back(patch.name);
  return modeling::Region::ofPatches(names);
}

}  // namespace

double suitableEdgeLength(const modeling::Body& body) {
  // Quadratic triangles, the default for mesh bodies, need half the nodes of flat ones; the
  // features of parts from CAD files add more.
  const double nodes = std::holds_alternative<modeling::MeshBody>(body) ? 300 : 600;
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", std::sqrt(1.05 * modeling::area(body) / nodes));
  return std::strtod(text, nullptr);
}

modeling::Material defaultMaterial() {
  return {"silicone", 0.2, 0.48, 1070};
}

modeling::Project makeProject(modeling::Body body, const std::string& name) {
  modeling::Project project;
  project.name = name;
  project.material = defaultMaterial();
  project.body = std::move(body);
  project.supports = {modeling::supportOfLowestTenth(project.body)};
  project.mesh.edgeLength = suitableEdgeLength(project.body);
  return project;
}

modeling::Project makeProject(const modeling::Primitive& primitive, modeling::Solid solid,
                              const std::string& name) {
  modeling::Project project;
  project.name = name;
  project.material = defaultMaterial();
  project.supports = {{"base", modeling::Support::Kind::kFixed, baseOf(primitive, solid)}};
  project.body = std::move(solid);
  project.primitive = primitive;
  project.mesh.edgeLength = suitableEdgeLength(project.body);
  return project;
}

}  // namespace palpa::app

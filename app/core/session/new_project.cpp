#include "app/core/session/new_project.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace palpa::app {

double suitableEdgeLength(const modeling::Body& body) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", std::sqrt(1.05 * modeling::area(body) / 600));
  return std::strtod(text, nullptr);
}

modeling::Material defaultMaterial() {
  return {"silicone", 0.2, 0.48, 1070};
}

modeling::Support baseSupport(const modeling::Body& body) {
  const auto [low, high] = modeling::boundingBox(body);
  modeling::Support base;
  base.name = "base";
  base.where =
      modeling::Region::below(Eigen::Vector3d::UnitZ(), low.z() + 0.1 * (high.z() - low.z()));
  return base;
}

modeling::Project makeProject(modeling::Body body, const std::string& name) {
  modeling::Project project;
  project.name = name;
  project.material = defaultMaterial();
  project.body = std::move(body);
  project.supports = {baseSupport(project.body)};
  project.mesh.edgeLength = suitableEdgeLength(project.body);
  return project;
}

}  // namespace palpa::app

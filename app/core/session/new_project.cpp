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
  return {"silicone", 0.2, 0.48};
}

modeling::Project makeProject(modeling::Body body, const std::string& name) {
  modeling::Project project;
  project.name = name;
  project.material = defaultMaterial();
  project.body = std::move(body);
  const auto [low, high] = modeling::boundingBox(project.body);
  modeling::Support base;
  base.name = "base";
  base.where =
      modeling::Region::below(Eigen::Vector3d::UnitZ(), low.z() + 0.1 * (high.z() - low.z()));
  project.supports = {base};
  project.mesh.edgeLength = suitableEdgeLength(project.body);
  return project;
}

}  // namespace palpa::app

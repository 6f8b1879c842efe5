#include "app/core/session/new_project.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "modeling/project/proposed_support.h"

namespace palpa::app {

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

}  // namespace palpa::app

#include "bench/sphere.h"

#include <cmath>
#include <numbers>

#include "modeling/shapes/primitives.h"

namespace palpa::bench {

using Eigen::Vector3d;

modeling::Project sphereProject(int cellsPerCubeEdge) {
  modeling::Project project;
  project.name = "bench";
  project.material = {"silicone-like", 0.1, 0.45};
  project.body = modeling::makeSphere(25);
  project.supports.push_back({"base", modeling::Support::Kind::kFixed,
                              modeling::Region::below(Vector3d::UnitZ(), -20), Vector3d::Zero()});
  project.mesh.edgeLength = 25 * std::numbers::pi / 2 / cellsPerCubeEdge;
  project.mesh.engine = modeling::Engine::kTriangles;  // of which the cells say how many
  return project;
}

std::vector<Vector3d> pointsOnSphere(int count) {
  std::vector<Vector3d> points;
  for (int k = 0; k < count; ++k) {
    const double z = 0.95 - 1.5 * (k + 0.5) / count;
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    points.emplace_back(25 * r * std::cos(angle), 25 * r * std::sin(angle), 25 * z);
  }
  return points;
}

}  // namespace palpa::bench

#include "core_projects.h"

#include <cmath>

#include "modeling/shapes/primitives.h"

namespace palpa::app::test {
namespace {

using modeling::Project;
using modeling::Region;
using modeling::Support;

Project project(modeling::Solid solid, double edgeLength, double poissonRatio) {
  Project result;
  result.name = "test";
  result.material = {"test", 0.1, poissonRatio};
  result.body = std::move(solid);
  result.mesh.edgeLength = edgeLength;
  return result;
}

}  // namespace

Project clampedSphere(double edgeLength, double poissonRatio) {
  Project result = project(modeling::makeSphere(25), edgeLength, poissonRatio);
  result.supports.push_back({"base", Support::Kind::kFixed,
                             Region::below(Eigen::Vector3d::UnitZ(), -20),
                             Eigen::Vector3d::Zero()});
  // The edge length says how fine it is, unless a test asks for splines.
  result.mesh.engine = modeling::Engine::kTriangles;
  return result;
}

Project paintedSphere(double edgeLength, double poissonRatio) {
  Project result = clampedSphere(edgeLength, poissonRatio);
  // Points at the height h above the lowest one are at a distance of √(2 R h) from it.
  result.supports[0].where = {{modeling::Stroke{{{0, 0, -25}}, std::sqrt(2.0 * 25.0 * 5.0)}}};
  return result;
}

Project clampedCylinder(double edgeLength, double poissonRatio) {
  Project result = project(modeling::makeCylinder(20, 60), edgeLength, poissonRatio);
  result.supports.push_back(
      {"base", Support::Kind::kFixed, Region::ofPatches({"bottom"}), Eigen::Vector3d::Zero()});
  return result;
}

Project freeBox(double edgeLength) {
  return project(modeling::makeBox({40, 30, 20}), edgeLength, 0.45);
}

}  // namespace palpa::app::test

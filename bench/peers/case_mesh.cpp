#include "bench/peers/case_mesh.h"

#include <cmath>

#include "modeling/mesh/mesh.h"

namespace palpa::bench {

using Eigen::Vector3d;

modeling::Project projectOf(const PeerCase& body, modeling::Engine engine, double size) {
  modeling::Project project = body.project;
  project.mesh = {};
  project.mesh.engine = engine;
  if (engine == modeling::Engine::kSplines)
    project.mesh.accuracy = size;
  else
    project.mesh.edgeLength = size;
  // The same mesh as the other methods have.
  if (engine == modeling::Engine::kTriangles) return project;
  modeling::Touch touch;
  touch.at = body.reference.at;
  touch.radius = body.reference.radius;
  project.touches.push_back(touch);
  return project;
}

app::BoundarySetup triangleSetup(const PeerCase& body, double size) {
  const modeling::Project project = projectOf(body, modeling::Engine::kTriangles, size);
  return app::makeBoundarySetup(
      app::ProjectGeometry(project),
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
}

double stiffnessError(const PeerCase& body, const Eigen::Matrix3d& compliance) {
  const Vector3d& direction = body.reference.direction;
  return std::abs(body.reference.compliance / direction.dot(compliance * direction) - 1);
}

void SurfaceError::add(const Vector3d& x, const Vector3d& found, double weight) {
  const Vector3d exact = body_.exactDisplacement(x);
  error_ += weight * (found - exact).squaredNorm();
  scale_ += weight * exact.squaredNorm();
}

}  // namespace palpa::bench

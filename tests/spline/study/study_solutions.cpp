#include "study_solutions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace palpa::bem::test {

using Eigen::Vector3d;

std::unique_ptr<SplineBody> solveSplines(const SplineSurface& surface, const Material& material,
                                         const ExactField& exact) {
  return fastest([&] {
    return std::make_unique<SplineBody>(surface, material, exact, kSplineOptions,
                                        Precision::kAutomatic);
  });
}

int studyRounds() {
  const char* rounds = std::getenv("PALPA_STUDY_ROUNDS");
  return rounds ? std::max(1, std::atoi(rounds)) : 1;
}

BoundaryMesh triangleMesh(const modeling::Solid& solid, double edgeLength,
                          const std::vector<modeling::MeshRegion>& regions, bool isRefined) {
  modeling::MeshSettings settings;
  settings.edgeLength = edgeLength;
  settings.refinementLevels = isRefined ? 2 : 0;
  settings.refineAtBorders = isRefined;
  const modeling::SurfaceMesh made = modeling::mesh(solid, settings, regions);
  BoundaryMesh mesh{made.positions, made.triangles, made.smoothingGroupOfTriangle,
                    std::vector<int>(made.triangles.size(), 0)};
  for (std::size_t r = 0; r < made.trianglesOfRegion.size(); ++r)
    for (const int t : made.trianglesOfRegion[r]) mesh.tags[t] = static_cast<int>(r) + 1;
  return mesh;
}

std::unique_ptr<SolvedBody> solveTriangles(const BoundaryMesh& mesh, const FixedPlaces& fixed,
                                           const Material& material, const ExactField& exact) {
  const BoundaryMesh withSupport = retagged(mesh, 1, fixed);
  return fastest([&] {
    return std::make_unique<SolvedBody>(
        withSupport, material, exact,
        [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; },
        SolvedBody::Options{Precision::kAutomatic, {}});
  });
}

StudyStep stepOf(const SplineBody& body, const ExactField& exact) {
  StudyStep step;
  step.coefficients = body.surface.coefficientCount();
  step.elements = body.surface.elementCount();
  step.size = std::sqrt(body.area() / step.elements);
  step.error = body.displacementError(exact);
  step.best = body.leastDisplacementError(exact);
  step.assemble = body.times.assemble;
  step.factorise = body.times.factorise;
  return step;
}

StudyStep stepOf(const SolvedBody& body, const ExactField& exact) {
  StudyStep step;
  step.coefficients = body.mesh.nodeCount();
  step.elements = body.mesh.triangleCount();
  step.size = std::sqrt(body.mesh.surfaceArea() / step.elements);
  step.error = body.displacementError(exact);
  step.assemble = body.times.assemble;
  step.factorise = body.times.factorise;
  return step;
}

}  // namespace palpa::bem::test

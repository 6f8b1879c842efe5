#include "modeling/mesh/mesh.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

/// The nodes of a solid's mesh lie where the splines say, also at seams and poles, and after knots
/// were inserted.
TEST(SplineMesh, NodesLieOnTheSplines) {
  for (const modeling::Solid& solid : {modeling::makeSphere(25, 7), modeling::makeBox({40, 30, 20}),
                                       modeling::makeCylinder(20, 60), makeTorus(30, 10)}) {
    modeling::MeshSettings settings;
    settings.edgeLength = 7;
    const modeling::SurfaceMesh triangles = modeling::mesh(solid, settings);
    const BoundaryMesh mesh{triangles.positions, triangles.triangles,
                            triangles.smoothingGroupOfTriangle,
                            std::vector<int>(triangles.triangles.size(), 0)};
    const TractionSlots meshSlots(mesh);
    for (const modeling::Solid& analysed : {solid, halved(solid)}) {
      const SplineSurface surface = app::splineSurfaceOf(analysed);
      const SplineTractions tractions(surface);
      const SplineMesh on(
          surface, tractions, mesh, meshSlots,
          app::splineTriangles(solid, modeling::SurfaceEvaluator(solid), triangles));
      Eigen::VectorXd points(3 * surface.coefficientCount());
      for (int k = 0; k < surface.coefficientCount(); ++k)
        points.segment<3>(3 * k) = surface.controlPoints()[k];
      Eigen::MatrixXd nodes;
      on.displacements(points, nodes);
      for (int node = 0; node < mesh.nodeCount(); ++node)
        EXPECT_LE((nodes.col(0).segment<3>(3 * node) - mesh.nodes[node]).norm(), 1e-9);
      for (int t = 0; t < mesh.triangleCount(); ++t) {
        const Vector3d middle = Vector3d::Constant(1.0 / 3);
        const auto at = on.at(t, middle);
        const Vector3d x =
            surface.evaluate({at.element, at.parameters[0], at.parameters[1]}).position;
        EXPECT_LE((x - mesh.point(t, middle)).norm(), 0.15 * 7);
      }
    }
  }
}

}  // namespace
}  // namespace palpa::bem::test

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "app/verification/exact/simple_meshes.h"
#include "app/verification/exact/solved_body.h"
#include "bem/model/surface_point.h"
#include "bem/triangle/results.h"
#include "bem/triangle/triangle_discretisation.h"
#include "bem/triangle/triangle_interior.h"

namespace palpa::bem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using verification::ExactField;
using verification::SolvedBody;

/// Points below the middles, edges and corners of every few triangles.
std::vector<Vector3d> pointsBelow(const BoundaryMesh& mesh, double depthOverSize, int every) {
  std::vector<Vector3d> points;
  for (int t = 0; t < mesh.triangleCount(); t += every)
    for (const Vector3d& weights :
         {Vector3d(1, 1, 1), Vector3d(1, 1, 0.02), Vector3d(1, 0.02, 0.02)})
      points.push_back(mesh.point(t, weights / weights.sum()) -
                       depthOverSize * std::sqrt(2 * mesh.area(t)) * mesh.normal(t));
  return points;
}

struct Errors {
  double displacement = 0, rmsStress = 0, stress = 0;
};

/// Errors of states over the largest exact values.
Errors errorsOf(const std::vector<Vector3d>& points, const std::vector<InteriorState>& states,
                const ExactField& exact) {
  Errors errors;
  double largestU = 0, largestStress = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector3d u = exact.displacement(points[k]);
    const Matrix3d stress = exact.stress(points[k]);
    largestU = std::max(largestU, u.norm());
    largestStress = std::max(largestStress, stress.norm());
    errors.displacement = std::max(errors.displacement, (states[k].displacement - u).norm());
    const double error = (states[k].stress - stress).norm();
    errors.stress = std::max(errors.stress, error);
    errors.rmsStress += error * error / static_cast<double>(points.size());
  }
  errors.displacement /= largestU;
  errors.stress /= largestStress;
  errors.rmsStress = std::sqrt(errors.rmsStress) / largestStress;
  return errors;
}

Errors measure(const SolvedBody& body, const ExactField& exact, double depth, double layer) {
  const std::vector<Vector3d> points = pointsBelow(body.mesh, depth, 5);
  const TriangleInterior interior(body.mesh, body.slots, body.material, points, {}, layer);
  return errorsOf(points, interior.evaluate(body.field.u.col(0), body.field.p.col(0), {}), exact);
}

SolvedBody sphereInPointField(int cells, const Material& material, const ExactField& exact) {
  return {verification::retagged(verification::sphereMesh(25, cells), 1,
                                 [](const Vector3d& x) { return x[2] < -10; }),
          material, exact,
          [](int tag) { return tag == 1 ? SlotCondition::kFixed : SlotCondition::kTraction; }};
}

TEST(InteriorEvaluator, OfTrianglesFollowsAPointForceAtEveryDepth) {
  for (const double nu : {0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = verification::kelvinField({8, -5, 45}, {0.03, -0.02, 0.06}, material);
    const SolvedBody body = sphereInPointField(11, material, exact);
    for (const double depth : {0.01, 0.1, 0.25, 0.5, 1.0, 2.0}) {
      std::printf("nu %.1f, depth %4.2f:", nu, depth);
      for (const double layer : {0.0, TriangleInterior::kLayer, 0.5}) {
        const Errors errors = measure(body, exact, depth, layer);
        std::printf("  layer %.2f: u %.1e, stress %.1e (rms %.1e)", layer, errors.displacement,
                    errors.stress, errors.rmsStress);
        if (layer != TriangleInterior::kLayer) continue;
        EXPECT_LE(errors.displacement, 0.012) << "on the surface, linear between the nodes";
        EXPECT_LE(errors.rmsStress, 0.02) << "elements of 3.6 mm, second order";
      }
      std::printf("\n");
    }
  }
}

TEST(InteriorEvaluator, KeepsALinearFieldOnABoxUpToFacesEdgesAndCorners) {
  for (const double nu : {0.3, 0.49}) {
    const Material material{0.1, nu};
    const ExactField exact =
        verification::linearField(verification::generalGradient(false), {0.1, 0, 0}, material);
    const SolvedBody body(
        verification::boxMesh({-20, -15, 0}, {20, 15, 20}, 8, 6, 4), material, exact,
        [](int tag) { return tag == 4 ? SlotCondition::kFixed : SlotCondition::kTraction; });
    const std::vector<Vector3d> points{{0, 0, 10},      {1, 2, 19.99},      {19.9, 3, 10},
                                       {19.9, 14.9, 9}, {19.9, 14.9, 19.9}, {-19.5, 14.8, 0.3},
                                       {0, 0, 0.001},   {0, 0, 20},         {3, -13, 2}};
    const TriangleInterior interior(body.mesh, body.slots, material, points, {});
    const Errors errors =
        errorsOf(points, interior.evaluate(body.field.u.col(0), body.field.p.col(0), {}), exact);
    std::printf("linear field: u %.1e, stress %.1e\n", errors.displacement, errors.stress);
    EXPECT_LE(errors.displacement, 1e-3);
    EXPECT_LE(errors.stress, 1e-3);
  }
}

TEST(InteriorEvaluator, AgreesWithThePointByPointIntegrals) {
  const Material material{0.1, 0.3};
  const ExactField exact = verification::kelvinField({8, -5, 45}, {0.03, -0.02, 0.06}, material);
  const SolvedBody body = sphereInPointField(9, material, exact);
  std::vector<Vector3d> points;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  while (points.size() < 40) {
    const Vector3d x = 22 * Vector3d(uniform(random), uniform(random), uniform(random));
    if (x.norm() < 22) points.push_back(x);
  }
  const TriangleInterior interior(body.mesh, body.slots, material, points, {}, 0);
  const auto states = interior.evaluate(body.field.u.col(0), body.field.p.col(0), {});
  double displacement = 0, stress = 0, largestU = 0, largestStress = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto exactly = interiorState(body.mesh, body.slots, body.field.u.col(0),
                                       body.field.p.col(0), material, points[k]);
    ASSERT_TRUE(exactly);
    largestU = std::max(largestU, exactly->displacement.norm());
    largestStress = std::max(largestStress, exactly->stress.norm());
    displacement = std::max(displacement, (states[k].displacement - exactly->displacement).norm());
    stress = std::max(stress, (states[k].stress - exactly->stress).norm());
  }
  std::printf("integrals: u %.1e, stress %.1e\n", displacement / largestU, stress / largestStress);
  EXPECT_LE(displacement, 2e-4 * largestU);
  EXPECT_LE(stress, 1e-3 * largestStress);
}

TEST(InteriorEvaluator, DoesNotDependOnTheNumberOfThreadsAndCanBeCancelled) {
  const TriangleDiscretisation on(verification::sphereMesh(25, 6));
  const Eigen::VectorXd u = Eigen::VectorXd::Random(3 * on.displacementCount()),
                        p = Eigen::VectorXd::Random(3 * on.slots().count());
  std::vector<Vector3d> points;
  for (int k = 0; k < 60; ++k) points.emplace_back(0.2 * k, -0.1 * k, 0.3 * k);
  points.push_back(Vector3d::Zero());
  const auto interior = on.makeInteriorEvaluator(points, Material{0.1, 0.3}, {});
  ASSERT_EQ(interior->pointCount(), 61);
  Job one, four;
  one.threads = 1;
  four.threads = 4;
  const auto first = interior->evaluate(u, p, one), second = interior->evaluate(u, p, four);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(first[k].displacement, second[k].displacement);
    EXPECT_EQ(first[k].stress, second[k].stress);
    EXPECT_TRUE(first[k].stress.allFinite());
  }
  std::stop_source stop;
  stop.request_stop();
  Job stopped;
  stopped.stop = stop.get_token();
  EXPECT_THROW(interior->evaluate(u, p, stopped), Cancelled);
  EXPECT_THROW(on.makeInteriorEvaluator(points, Material{0.1, 0.3}, stopped), Cancelled);
}

TEST(StrainOf, InvertsHookesLaw) {
  const Material material{0.1, 0.3};
  const Matrix3d gradient = verification::generalGradient(false);
  const Matrix3d strain = (gradient + gradient.transpose()) / 2;
  EXPECT_LE((strainOf(verification::hooke(gradient, material), material) - strain).norm(), 1e-14);
}

}  // namespace
}  // namespace palpa::bem

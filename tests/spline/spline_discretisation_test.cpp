#include "bem/spline/spline_discretisation.h"
#include "bem/dense/make_reference_problem.h"

#include <cstring>

#include "bem/spline/surface_part.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Material kMaterial{0.1, 0.3};

/// The coefficients of a linear field.
BoundaryField linearCoefficients(const SplineDiscretisation& on, const ExactField& exact) {
  BoundaryField field{Eigen::MatrixXd(3 * on.displacementCount(), 1), {}};
  for (int k = 0; k < on.displacementCount(); ++k)
    field.u.middleRows<3>(3 * k) = exact.displacement(on.surface().controlPoints()[k]);
  field.p = projectTraction(
      on.surface(), on.tractions(), allElements(on.surface()),
      [&](const Vector3d& x, const Vector3d& n) { return Vector3d(exact.stress(x) * n); },
      INFINITY);
  return field;
}

TEST(SplineDiscretisation, StressAtTheSlotsOfALinearField) {
  const ExactField exact = linearField(generalGradient(false), {0.1, -0.2, 0.3}, kMaterial);
  const Matrix3d stress = exact.stress(Vector3d::Zero());
  // On bent faces the projected tractions err, which the stress takes over.
  for (const auto& [solid, tolerance] : {std::pair(modeling::makeBox({40, 30, 20}), 1e-9),
                                         {modeling::makeSphere(25, 9), 3e-3},
                                         {modeling::makeCylinder(20, 60), 3e-2},
                                         {makeTorus(30, 10), 2e-3}}) {
    const auto on = discretised(solid, 5, [](const Vector3d&) { return 0; });
    const BoundaryField field = linearCoefficients(*on, exact);
    const auto found = on->surfaceStress(field.u.col(0), field.p.col(0), kMaterial);
    ASSERT_EQ(static_cast<int>(found.size()), on->meshSlots().count());
    double worst = 0;
    for (const Matrix3d& each : found)
      worst = std::max(worst, (each - stress).norm() / stress.norm());
    std::printf("stress at %zu slots: largest relative error %.1e\n", found.size(), worst);
    EXPECT_LE(worst, tolerance);
  }
}

TEST(SplineDiscretisation, ValuesOnTheMeshAreThoseOfTheField) {
  const ExactField exact = linearField(generalGradient(false), {0.1, -0.2, 0.3}, kMaterial);
  const auto on = discretised(modeling::makeBox({40, 30, 20}), 5,
                              [](const Vector3d& x) { return x.z() < 1e-6 ? 1 : 0; });
  const BoundaryField field = linearCoefficients(*on, exact), values = on->valuesOnMesh(field);
  const BoundaryMesh& mesh = on->mesh();
  for (int k = 0; k < mesh.nodeCount(); ++k)
    EXPECT_LE((values.u.col(0).segment<3>(3 * k) - exact.displacement(mesh.nodes[k])).norm(), 1e-9);
  const TractionSlots& slots = on->meshSlots();
  for (int t = 0; t < mesh.triangleCount(); t += 7) {
    const Vector3d weights(0.2, 0.3, 0.5), x = mesh.point(t, weights);
    const SurfacePoint place{t, weights, x, 0};
    const Vector3d traction = exact.stress(x) * mesh.normal(t);
    EXPECT_LE((on->tractionAt(place, field.p.col(0)) - traction).norm(), 1e-9 * traction.norm());
    EXPECT_LE((on->interpolate(place, field.u.col(0)) - exact.displacement(x)).norm(), 1e-9);
    EXPECT_LE((on->displacementAt(place, field.u.col(0), field.p.col(0), kMaterial) -
               exact.displacement(x))
                  .norm(),
              1e-5);
    const Discretisation::Weights row = on->displacementWeights(std::span(&place, 1));
    EXPECT_NEAR(row.sum(), 1, 1e-12);
    for (int corner = 0; corner < 3; ++corner) {
      const int slot = slots.ofCorner[t][corner];
      EXPECT_LE((values.p.col(0).segment<3>(3 * slot) - traction).norm(), 1e-9 * traction.norm());
    }
  }
  const Discretisation::Weights weights = on->placeWeights();
  for (int k = 0; k < on->displacementCount(); ++k) {
    Vector3d there = Vector3d::Zero();
    for (Discretisation::Weights::InnerIterator it(weights, k); it; ++it)
      there += it.value() * field.u.col(0).segment<3>(3 * it.col());
    EXPECT_LE((there - exact.displacement(on->places()[k])).norm(), 1e-9);
  }
}

TEST(SplineDiscretisation, AProblemIsReadBackBitForBit) {
  const auto on = discretised(modeling::makeSphere(25, 7), 8,
                              [](const Vector3d& x) { return isBelow(x) ? 1 : 0; });
  const auto conditions = fixedWhereTagged(on->slots());
  for (const Precision precision : {Precision::kDouble, Precision::kMixed, Precision::kSingle}) {
    const auto made = makeDenseReferenceProblem(*on, {conditions, kMaterial, {1e-5}, precision});
    std::vector<std::byte> stored;
    made->write([&](std::span<const std::byte> bytes) {
      stored.insert(stored.end(), bytes.begin(), bytes.end());
    });
    std::size_t at = 0;
    const auto read = readDenseReferenceProblem(
        *on, {conditions, kMaterial, {}, precision}, [&](std::span<std::byte> bytes) {
          ASSERT_LE(at + bytes.size(), stored.size());
          std::memcpy(bytes.data(), &stored[at], bytes.size());
          at += bytes.size();
        });
    EXPECT_EQ(at, stored.size());
    BoundaryField load{Eigen::MatrixXd::Zero(3 * on->displacementCount(), 1),
                       Eigen::MatrixXd::Zero(3 * on->slots().count(), 1)};
    for (int s = 0; s < on->slots().count(); ++s)
      if (conditions[s] == SlotCondition::kTraction) load.p(3 * s + 2, 0) = 1e-3 * (s % 5);
    EXPECT_EQ(made->solve(load), read->solve(load));
  }
}

std::vector<std::byte> written(const SplineSurface& surface) {
  std::vector<std::byte> bytes;
  surface.write([&](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  });
  return bytes;
}

TEST(SplineSurface, WritesAllThatItIs) {
  const modeling::Solid sphere = modeling::makeSphere(25, 7);
  const SplineSurface surface = app::splineSurfaceOf(sphere);
  const auto bytes = written(surface);
  EXPECT_EQ(bytes, written(app::splineSurfaceOf(modeling::makeSphere(25, 7))));
  EXPECT_NE(bytes, written(app::splineSurfaceOf(modeling::makeSphere(25.1, 7))));
  SplineSurface tagged = surface;
  tagged.setTag(3, 1);
  EXPECT_NE(bytes, written(tagged));
  const auto part = [&](double height) {
    return written(withPart(
        surface, [=](const Vector3d& x) { return x.z() - height; }, 1));
  };
  EXPECT_EQ(part(-16), part(-16));
  // Cuts the same rectangles at other places.
  EXPECT_NE(part(-16), part(-16.001));
}

TEST(SplineDiscretisation, KnowsItsInside) {
  const auto on = discretised(modeling::makeSphere(25, 5), 8, [](const Vector3d&) { return 0; });
  const VectorXd u = VectorXd::Zero(3 * on->displacementCount()),
                 p = VectorXd::Zero(3 * on->slots().count());
  EXPECT_TRUE(on->interiorState(u, p, kMaterial, {1, 2, 3}));
  EXPECT_TRUE(on->interiorState(u, p, kMaterial, {0, 0, 24.9}));
  EXPECT_FALSE(on->interiorState(u, p, kMaterial, {0, 0, 25.1}));
  EXPECT_FALSE(on->interiorState(u, p, kMaterial, {100, 0, 40}));
}

}  // namespace
}  // namespace palpa::bem::test

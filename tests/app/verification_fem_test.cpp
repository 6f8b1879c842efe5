// The finite element solutions of fem.json against the whole way from a project to samples and
// reactions: what `palpa-cli verify` runs, and other meshes.
#include <gtest/gtest.h>

#include <cstdio>

#include "app/core/model/touch_model.h"
#include "app/verification/fem_case.h"
#include "app/verification/verification.h"

namespace palpa::verification {
namespace {

using nlohmann::json;

const json& femCase(const std::string& id) {
  return ReferenceData::builtIn().finiteElementCase(id);
}

FemSolution solveTriangles(const std::string& id, double edgeLength, bool isRefined = false) {
  modeling::MeshSettings mesh;
  mesh.engine = modeling::Engine::kTriangles;
  mesh.edgeLength = edgeLength;
  mesh.refinementLevels = isRefined ? 2 : 0;
  mesh.refineAtBorders = mesh.refineAtSharpEdges = isRefined;
  return solveFem(femCase(id), mesh, {});
}

class FiniteElements : public ::testing::TestWithParam<const char*> {};

TEST_P(FiniteElements, AreReproducedByAllEngines) {
  Selection selection;
  selection.names = {GetParam()};
  const Plan plan = makePlan(ReferenceData::builtIn(), selection);
  ASSERT_EQ(plan.tasks.size(), 3u);
  for (const Task& task : plan.tasks) {
    const Result result = task.run({});
    EXPECT_GE(result.checks.size(), 4u);
    for (const Check& check : result.checks) {
      std::printf("%s %s n %d: %s %.2e\n", result.name.c_str(), result.engine.c_str(),
                  result.coefficients, check.quantity.c_str(), check.value);
      EXPECT_TRUE(check.passes()) << result.engine << ": " << check.quantity << " " << check.value
                                  << " for " << check.bound;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Cases, FiniteElements,
                         ::testing::Values("a_cyl_side", "b_cyl_push_nu0.30", "b_cyl_push_nu0.45",
                                           "c_sph_pole", "c_sph_equator"),
                         [](const auto& id) {
                           std::string name = id.param;
                           std::erase_if(name, [](char c) { return c == '_' || c == '.'; });
                           return name;
                         });

// The tolerances equal the tolerances of these cases in app/verification, except for other meshes.

TEST(FiniteElements, ASideIsPushedOnAUniformMesh) {
  const FemSolution solution = solveTriangles("a_cyl_side", 2.25);
  EXPECT_NEAR(solution.coefficients, 2500, 250);
  EXPECT_LE(solution.errors.atLoad, 0.015);
  EXPECT_LE(solution.errors.anywhere, 0.01);
  EXPECT_LE(solution.errors.energy, 0.01);
  // The traction is singular along the rim of the base; a uniform mesh pays for that.
  EXPECT_LE(solution.errors.reaction, 0.01);
  EXPECT_LE(solution.balance, 0.006);
}

TEST(FiniteElements, APoleBetweenNodesIsPushed) {
  // With 1.80 mm there is a node at the pole.
  const FemSolution solution = solveTriangles("c_sph_pole", 1.87);
  EXPECT_NEAR(solution.coefficients, 2400, 300);
  EXPECT_LE(solution.errors.atLoad, 0.015);
  EXPECT_LE(solution.errors.anywhere, 0.015);
  EXPECT_LE(solution.errors.reaction, 0.01);
  EXPECT_LE(solution.errors.energy, 0.015);
  EXPECT_LE(solution.balance, 0.003);
}

TEST(FiniteElements, GradingTowardsTheRimReachesTheReactionWithFewerNodes) {
  const FemSolution even = solveTriangles("b_cyl_push_nu0.45", 3);
  const FemSolution graded = solveTriangles("b_cyl_push_nu0.45", 6, true);
  EXPECT_LT(graded.coefficients, 1.2 * even.coefficients);
  EXPECT_LT(graded.errors.reaction, even.errors.reaction);
}

}  // namespace
}  // namespace palpa::verification

// Splines and triangles beside each other: what a person reads off must not depend on the engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/core/deformed_solid.h"
#include "app/core/error_estimate.h"
#include "app/core/touch.h"
#include "core_projects.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/import.h"
#include "modeling/project/project_file.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::app {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using modeling::Engine;

std::shared_ptr<const TouchModel> build(modeling::Project project, Engine engine) {
  project.mesh.engine = engine;
  return buildTouchModel(project, {}, {});
}

std::vector<std::string> examples() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(PALPA_PROJECTS))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

struct Played {
  std::shared_ptr<const TouchModel> model;
  TouchState state;
  double error;  ///< estimated, relative
};

Played play(const modeling::Project& project, Engine engine) {
  Played played{build(project, engine), {}, 0};
  played.state = playTouches(*played.model, project.touches, 0, {});
  played.error = estimateError(*played.model, played.state);
  return played;
}

class Example : public testing::TestWithParam<std::string> {};

/// Largest displacement of a node of either mesh; both engines share the mesh.
Eigen::MatrixXd onNodes(const Played& played) {
  return played.model->setup().discretisation->valuesOnMesh(played.state.field).u;
}

TEST_P(Example, BothEnginesAgreeWithinTheirStatedErrors) {
  const modeling::Project project =
      modeling::readProject(fs::path(PALPA_PROJECTS) / (GetParam() + ".json"));
  const Played splines = play(project, Engine::splines);
  const Played triangles = play(project, Engine::triangles);
  ASSERT_TRUE(splines.model->setup().splines);
  ASSERT_FALSE(triangles.model->setup().splines);
  const double stated = splines.error + triangles.error;
  ASSERT_EQ(splines.state.contacts.size(), triangles.state.contacts.size());
  double force = 0;
  for (std::size_t k = 0; k < splines.state.contacts.size(); ++k) {
    const Vector3d a = splines.state.contacts[k].force, b = triangles.state.contacts[k].force;
    force = std::max(force, (a - b).norm() / b.norm());
  }
  const Eigen::MatrixXd a = onNodes(splines), b = onNodes(triangles);
  const double displacement = (a - b).norm() / b.norm();
  std::printf(
      "%s: splines n %d, estimate %.2g %%; triangles n %d, estimate %.2g %%; forces differ by "
      "%.2g %%, displacements by %.2g %%\n",
      project.name.c_str(), splines.model->setup().discretisation->displacementCount(),
      100 * splines.error, triangles.model->setup().discretisation->displacementCount(),
      100 * triangles.error, 100 * force, 100 * displacement);
  EXPECT_LE(force, stated);
  EXPECT_LE(displacement, stated);
  EXPECT_LE(splines.state.relativeBalance, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Projects, Example, testing::ValuesIn(examples()),
                         [](const testing::TestParamInfo<std::string>& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Engines, AutomaticMeansSplinesWhereSupportsEndWithPatches) {
  EXPECT_TRUE(build(test::clampedCylinder(6), Engine::automatic)->setup().splines);
  EXPECT_FALSE(build(test::clampedCylinder(6), Engine::triangles)->setup().splines);
  // Below z = -20 mm: the border cuts patches.
  EXPECT_FALSE(build(test::clampedSphere(6), Engine::automatic)->setup().splines);
  EXPECT_TRUE(build(test::clampedSphere(6), Engine::splines)->setup().splines);
}

/// The sphere held at the bottom and pulled up at its top by 3 mm.
Played pulledSphere() {
  modeling::Project project = test::clampedSphere(4);
  project.touches = {{"pull", {0, 0, 25}, modeling::TouchDisplacement{{0, 0, 3}}, 8.0}};
  return play(project, Engine::splines);
}

TEST(DeformedSolid, HasTheDisplacedSurface) {
  const Played played = pulledSphere();
  const modeling::Solid deformed = deformedSolid(*played.model, played.state.field);
  // Sampled where the nodes of the mesh went.
  const bem::BoundaryMesh& mesh = played.model->setup().mesh();
  const Eigen::MatrixXd u = onNodes(played);
  const modeling::SurfaceEvaluator surface(deformed);
  const auto& parameters = played.model->surface().parameters;
  double largest = 0;
  for (int node = 0; node < mesh.nodeCount(); ++node) {
    const Vector3d expected = mesh.nodes[node] + u.col(0).segment<3>(3 * node);
    const auto& at = parameters[node];
    largest = std::max(largest, (surface.position(at.patch, at.u, at.v) - expected).norm());
  }
  // At the border of the support two approximations of one displacement become one.
  EXPECT_LE(largest, 0.02);
  EXPECT_THROW(deformedSolid(*played.model, played.state.field, 1e6), modeling::ModelingError);
}

TEST(DeformedSolid, IsAProjectAndACadFileThatCanBeOpenedAgain) {
  const Played played = pulledSphere();
  const modeling::Project deformed =
      deformedProject(test::clampedSphere(4), *played.model, played.state.field);
  const fs::path folder = fs::path(testing::TempDir()) / "palpa-deformed";
  fs::create_directories(folder);
  modeling::writeProject(deformed, folder / "deformed.json");
  const modeling::Project again = modeling::readProject(folder / "deformed.json");
  EXPECT_NEAR(modeling::volume(again.body), modeling::volume(deformed.body),
              1e-9 * modeling::volume(deformed.body));
  modeling::exportCad(deformed.body, folder / "deformed.step", deformed.name, {});
  const modeling::ImportedBody imported = modeling::importBody(folder / "deformed.step", {}, {});
  ASSERT_TRUE(std::holds_alternative<modeling::Solid>(imported.body));
  EXPECT_NEAR(modeling::volume(imported.body), modeling::volume(deformed.body),
              1e-6 * modeling::volume(deformed.body));
  fs::remove_all(folder);
}

TEST(DeformedSolid, NeedsSplines) {
  const auto model = build(test::clampedSphere(6), Engine::triangles);
  EXPECT_THROW(deformedSolid(*model, model->rest().field), modeling::ModelingError);
}

}  // namespace
}  // namespace palpa::app

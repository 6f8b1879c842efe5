// Comparison of splines and triangles: results must not depend on the engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/deformed_solid.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/touch.h"
#include "bem/contact/contact_surface.h"
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

struct StaticTouchSolution {
  std::shared_ptr<const TouchModel> model;
  TouchState state;
  double error;  ///< estimated, relative
};

StaticTouchSolution play(std::shared_ptr<const TouchModel> model,
                         const modeling::Project& project) {
  StaticTouchSolution played{std::move(model), {}, 0};
  played.state = playTouches(*played.model, project.touches, 0, {});
  played.error = estimateError(*played.model, played.state);
  return played;
}

/// The same touches, wide enough for a model: either engine widens what it cannot carry, and a
/// wider touch is another one.
void widenTouches(modeling::Project& project, const TouchModel& model) {
  const auto surface = model.setup().discretisation->makeContactSurface(model.problem()->dofs());
  for (modeling::Touch& touch : project.touches) {
    const double radius = touch.radius.value_or(fingertipRadius(project));
    touch.radius = bem::makeContactMask(*surface, touch.at, radius).radius;
  }
}

class Example : public testing::TestWithParam<std::string> {};

/// Displacements at places all over the surface.
Eigen::Matrix3Xd displacementsAt(const StaticTouchSolution& played,
                                 const std::vector<Vector3d>& places) {
  Eigen::Matrix3Xd u(3, places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    u.col(static_cast<Eigen::Index>(k)) =
        sampleField(*played.model, played.state, places[k]).displacement;
  return u;
}

TEST_P(Example, BothEnginesAgreeWithinTheirStatedErrors) {
  modeling::Project project =
      modeling::readProject(fs::path(PALPA_PROJECTS) / (GetParam() + ".json"));
  const auto bySplines = build(project, Engine::kSplines);
  const auto byTriangles = build(project, Engine::kTriangles);
  for (const auto& model : {bySplines, byTriangles}) widenTouches(project, *model);
  const StaticTouchSolution splines = play(bySplines, project),
                            triangles = play(byTriangles, project);
  ASSERT_TRUE(splines.model->setup().splines);
  ASSERT_FALSE(triangles.model->setup().splines);
  const double stated = splines.error + triangles.error;
  ASSERT_EQ(splines.state.contacts.size(), triangles.state.contacts.size());
  double force = 0;
  for (std::size_t k = 0; k < splines.state.contacts.size(); ++k) {
    const Vector3d a = splines.state.contacts[k].force, b = triangles.state.contacts[k].force;
    force = std::max(force, (a - b).norm() / b.norm());
  }
  const std::vector<Vector3d>& places = splines.model->surface().positions;
  const Eigen::Matrix3Xd a = displacementsAt(splines, places),
                         b = displacementsAt(triangles, places);
  const double displacement = (a - b).norm() / b.norm();
  std::printf(
      "%s: splines n %d, estimate %.2g %%; triangles n %d, estimate %.2g %%; forces differ by "
      "%.2g %%, displacements by %.2g %%\n",
      project.name.c_str(), splines.model->setup().discretisation->displacementCount(),
      100 * splines.error, triangles.model->setup().discretisation->displacementCount(),
      100 * triangles.error, 100 * force, 100 * displacement);
  EXPECT_LE(force, stated);
  // The estimate may be off by a factor, and beside the contact it has few places.
  EXPECT_LE(displacement, 2 * stated);
  EXPECT_LE(splines.state.relativeBalance, 0.01);
}

TEST_P(Example, QuadraticTrianglesGiveTheForcesOfSplines) {
  modeling::Project project =
      modeling::readProject(fs::path(PALPA_PROJECTS) / (GetParam() + ".json"));
  if (!std::holds_alternative<modeling::Solid>(project.body)) return;
  // Under a ball there are as many masks as a mesh can represent, so coarse meshes differ by more.
  for (modeling::Touch& touch : project.touches)
    if (modeling::infoOf(touch.kind).isBall) {
      touch.kind = modeling::TouchKind::kGrab;
      touch.radius.reset();
      touch.friction = 0;
    }
  const auto byQuadratic = build(project, Engine::kQuadratic);
  const auto bySplines = build(project, Engine::kSplines);
  for (const auto& model : {byQuadratic, bySplines}) widenTouches(project, *model);
  const StaticTouchSolution quadratic = play(byQuadratic, project),
                            splines = play(bySplines, project);
  const double stated = quadratic.error + splines.error;
  double force = 0;
  for (std::size_t k = 0; k < splines.state.contacts.size(); ++k) {
    const Vector3d a = splines.state.contacts[k].force, b = quadratic.state.contacts[k].force;
    force = std::max(force, (a - b).norm() / a.norm());
  }
  std::printf("%s: quadratic n %d, estimate %.2g %%; splines %.2g %%; forces differ by %.2g %%\n",
              project.name.c_str(), quadratic.model->setup().discretisation->displacementCount(),
              100 * quadratic.error, 100 * splines.error, 100 * force);
  EXPECT_EQ(quadratic.model->setup().engine, Engine::kQuadratic);
  EXPECT_LE(force, stated);
  EXPECT_LE(quadratic.state.relativeBalance, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Projects, Example, testing::ValuesIn(examples()),
                         [](const testing::TestParamInfo<std::string>& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Engines, AutomaticMeansSplinesWhereSupportsAreWholePatches) {
  const auto engineOf = [](modeling::Project project, Engine wanted = Engine::kAutomatic) {
    project.mesh.engine = wanted;
    return modeling::engineOf(project);
  };
  EXPECT_EQ(engineOf(test::clampedCylinder(6)), Engine::kSplines);
  EXPECT_EQ(engineOf(test::clampedCylinder(6), Engine::kTriangles), Engine::kTriangles);
  EXPECT_EQ(engineOf(test::freeBox(6)), Engine::kSplines);
  // The border cuts patches.
  EXPECT_EQ(engineOf(test::clampedSphere(6)), Engine::kQuadratic);
  EXPECT_EQ(engineOf(test::paintedSphere(6)), Engine::kQuadratic);
  EXPECT_EQ(engineOf(test::clampedSphere(6), Engine::kSplines), Engine::kSplines);
  // A half space that contains one patch of a box and touches no other.
  modeling::Project box = test::freeBox(6);
  const auto [low, high] = modeling::boundingBox(box.body);
  box.supports = {{"base", modeling::Support::Kind::kFixed,
                   modeling::Region::below(Vector3d::UnitZ(), low.z() + 0.01), Vector3d::Zero()}};
  EXPECT_EQ(engineOf(box), Engine::kSplines);
  box.supports[0].where = modeling::Region::below(Vector3d::UnitZ(), low.z() + 3);
  EXPECT_EQ(engineOf(box), Engine::kQuadratic);
}

/// A body held at the bottom and pulled up at its top by 3 mm.
StaticTouchSolution pulled(modeling::Project project, double height) {
  project.mesh.elementLength = 6;
  project.touches = {{"pull", {0, 0, height}, modeling::TouchKind::kGrab, {0, 0, 3}, 8.0}};
  return play(build(project, Engine::kSplines), project);
}

/// Largest distance of the deformed solid's surface from where the nodes of the mesh went.
double largestDistance(const StaticTouchSolution& played) {
  const modeling::Solid deformed = deformedSolid(*played.model, played.state.field);
  const bem::BoundaryMesh& mesh = played.model->setup().mesh();
  const Eigen::MatrixXd u =
      played.model->setup().discretisation->valuesOnMesh(played.state.field).u;
  const modeling::SurfaceEvaluator surface(deformed);
  const auto& parameters = played.model->surface().parameters;
  double largest = 0;
  for (int node = 0; node < mesh.nodeCount(); ++node) {
    const Vector3d expected = mesh.nodes[node] + u.col(0).segment<3>(3 * node);
    const auto& at = parameters[node];
    largest = std::max(largest, (surface.position(at.patch, at.u, at.v) - expected).norm());
  }
  return largest;
}

TEST(DeformedSolid, HasTheDisplacedSurface) {
  const StaticTouchSolution cylinder = pulled(test::clampedCylinder(6), 60);
  EXPECT_LE(largestDistance(cylinder), 1e-9);
  // At a border that cuts patches two approximations of one displacement become one.
  EXPECT_LE(largestDistance(pulled(test::clampedSphere(6), 25)), 0.05 * 3);

  // Through the origin and out on the other side.
  const auto& points = cylinder.model->setup().refinedSolid->controlPoints();
  bem::BoundaryField mirrored = cylinder.state.field;
  for (std::size_t k = 0; k < points.size(); ++k)
    mirrored.u.col(0).segment<3>(3 * static_cast<Eigen::Index>(k)) = -2 * points[k];
  EXPECT_THROW(deformedSolid(*cylinder.model, mirrored), modeling::ModelingError);
}

TEST(DeformedSolid, IsAProjectAndACadFileThatCanBeOpenedAgain) {
  const StaticTouchSolution played = pulled(test::clampedCylinder(6), 60);
  const modeling::Project deformed =
      deformedProject(test::clampedCylinder(6), *played.model, played.state.field);
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
  const auto model = build(test::clampedSphere(6), Engine::kTriangles);
  EXPECT_THROW(deformedSolid(*model, model->rest().field), modeling::ModelingError);
}

}  // namespace
}  // namespace palpa::app

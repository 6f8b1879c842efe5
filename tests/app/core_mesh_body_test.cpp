// Mesh bodies through the whole chain: read from a file's content, held, solved, touched.
#include <gtest/gtest.h>

#include <numbers>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/touch.h"
#include "core_projects.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/mesh/mesh.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Region;
using modeling::Support;

std::shared_ptr<const TouchModel> build(const modeling::Project& project) {
  return buildTouchModel(project, BuildOptions{}, Job{});
}

std::string point(const Vector3d& p) {
  char text[120];
  std::snprintf(text, sizeof text, "%.9g %.9g %.9g\n", p.x(), p.y(), p.z());
  return text;
}

/// The triangles of a meshed project as STL text.
std::string stl(const modeling::Project& project, double edgeLength) {
  modeling::MeshSettings settings;
  settings.edgeLength = edgeLength;
  const modeling::SurfaceMesh mesh = modeling::mesh(project.body, settings);
  std::string text = "solid\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int n : triangle) text += "vertex " + point(mesh.positions[n]);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

/// The same project with its body taken through an STL file.
modeling::Project imported(modeling::Project project, double fileEdgeLength) {
  const std::string text = stl(project, fileEdgeLength);
  project.body = modeling::parseMesh(text, modeling::FileFormat::kStl, "test");
  return project;
}

double touchForce(const TouchModel& model, const Vector3d& at, const Vector3d& by) {
  const modeling::Touch touch{"push", at, modeling::TouchKind::kGrab, by, 9.0};
  const TouchState state = playTouches(model, std::vector{touch});
  EXPECT_LE(state.relativeBalance, 0.01);
  return state.contacts[0].force.dot(by.normalized());
}

TEST(MeshBodyModel, AnImportedSphereFeelsLikeTheSplineSphere) {
  const modeling::Project spline = test::clampedSphere(3.5);
  const double expected = touchForce(*build(spline), {0, 0, 25}, {0, 0, -2});
  const double force = touchForce(*build(imported(spline, 1.5)), {0, 0, 25}, {0, 0, -2});
  EXPECT_NEAR(force / expected, 1.0, 0.02);
}

TEST(MeshBodyModel, FacesCanBeHeldAndLoaded) {
  // A box from twelve triangles on three rollers under pressure: a linear field, exact.
  modeling::Project project = imported(test::freeBox(7), 50);
  const auto& body = std::get<modeling::MeshBody>(project.body);
  ASSERT_EQ(body.faceNames().size(), 6U);
  const auto faceAt = [&](int axis, double value) {
    for (std::size_t t = 0; t < body.triangles().size(); ++t) {
      bool lies = true;
      for (const int n : body.triangles()[t])
        lies = lies && std::abs(body.positions()[n][axis] - value) < 1e-9;
      if (lies) return body.faceNames()[body.faceOfTriangle()[t]];
    }
    return std::string();
  };
  for (const auto& [axis, value] : {std::pair{2, 0.0}, std::pair{0, -20.0}, std::pair{1, -15.0}})
    project.supports.push_back({"support " + std::to_string(axis), Support::Kind::kRoller,
                                Region::ofPatches({faceAt(axis, value)}), Vector3d::Zero()});
  project.loads.push_back({"press", modeling::Pressure{Region::ofPatches({faceAt(2, 20)}), 0.01}});
  const auto model = build(project);
  const FieldSample corner = sampleField(*model, model->rest(), {20, 15, 20});
  EXPECT_NEAR(corner.displacement[2], -0.01 / 0.1 * 20, 1e-6);
  EXPECT_NEAR(corner.displacement[0], 0.45 * 0.01 / 0.1 * 40, 1e-6);
  EXPECT_NEAR(model->rest().supports[0].resultant.force[2], 0.01 * 40 * 30, 1e-6);
}

TEST(MeshBodyModel, ACavityMakesTheBodySofter) {
  // Two concentric spheres from one file; the inner surface is free.
  modeling::Project project = test::clampedSphere(5);
  const double full = touchForce(*build(imported(project, 2)), {0, 0, 25}, {0, 0, -2});
  const auto scaled = [&](double factor) {
    modeling::MeshSettings settings;
    settings.edgeLength = 2;
    const modeling::SurfaceMesh mesh = modeling::mesh(project.body, settings);
    std::string text;
    for (const Vector3d& p : mesh.positions) text += "v " + point(factor * p);
    for (const auto& [a, b, c] : mesh.triangles) {
      const int count = static_cast<int>(mesh.positions.size());
      text += "f " + std::to_string(a - count) + " " + std::to_string(b - count) + " " +
              std::to_string(c - count) + "\n";
    }
    return text;
  };
  project.body = modeling::parseMesh(scaled(1.0) + scaled(0.6), modeling::FileFormat::kObj, "test");
  EXPECT_NEAR(volume(project.body), 4.0 / 3.0 * std::numbers::pi * 15625 * (1 - 0.216), 300);
  const double hollow = touchForce(*build(project), {0, 0, 25}, {0, 0, -2});
  EXPECT_GT(hollow, 0.2 * full);
  EXPECT_LT(hollow, 0.95 * full);
}

}  // namespace
}  // namespace palpa::app

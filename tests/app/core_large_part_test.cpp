// A part with many holes from another program: too large for memory, or too coarse for its details.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "app/core/model/geometry_error.h"
#include "app/core/model/model_memory.h"
#include "app/core/model/suggest_mesh.h"
#include "app/core/session/new_project.h"
#include "app/core/session/rebuild_pipeline.h"
#include "base/count_text.h"
#include "bem/compressed/make_problem.h"
#include "modeling/exchange/import.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/primitives.h"
#include "tests/app/core_projects.h"
#include "tests/modeling/cad_files.h"
#include "tests/modeling/cad_shapes.h"

namespace palpa::app {
namespace {

/// A plate with 6 holes, imported as a STEP file; it becomes a mesh body.
const modeling::Project& plate() {
  static const modeling::Project project = [] {
    const modeling::tests::Folder folder;
    modeling::tests::writeForeign(modeling::tests::perforatedPlate(2, 3),
                                  folder.file("plate.step"));
    return makeProject(modeling::importBody(folder.file("plate.step")).body, "plate");
  }();
  return project;
}

std::string errorOf(const modeling::Project& project, const BuildOptions& options) {
  try {
    buildTouchModel(project, options, {});
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// Memory for about 400 nodes.
BuildOptions smallMemory() {
  BuildOptions options;
  options.memoryLimit =
      expectedBytes({400, 1000}, modeling::Engine::kQuadratic, bem::Precision::kAutomatic);
  return options;
}

TEST(LargePart, TheMessageHasReadableNumbersAndNoControlPoints) {
  modeling::Project project = plate();
  ASSERT_TRUE(std::holds_alternative<modeling::MeshBody>(project.body));
  project.mesh.edgeLength = 0.2;
  const std::string error = errorOf(project, smallMemory());
  EXPECT_NE(error.find(" of memory for "), std::string::npos) << error;
  EXPECT_NE(error.find("00 nodes, and "), std::string::npos) << error;
  EXPECT_EQ(error.find("e+"), std::string::npos) << error;
  EXPECT_EQ(error.find("control point"), std::string::npos) << error;
}

TEST(LargePart, TheSuggestedEdgeLengthFitsIntoMemoryAndBoundsABody) {
  modeling::Project project = plate();
  project.mesh.edgeLength = 1.5;
  BuildOptions options;
  options.memoryLimit =
      0.5 * expectedBytes({modeling::estimateNodeCount(project.body, project.mesh, {}), 0},
                          modeling::engineOf(project), bem::Precision::kAutomatic);
  EXPECT_NE(errorOf(project, options).find("of memory for"), std::string::npos);
  const auto mesh = suggestMesh(project, options, {});
  ASSERT_TRUE(mesh);
  EXPECT_GT(mesh->edgeLength, project.mesh.edgeLength);
  const modeling::SurfaceMesh surface =
      modeling::mesh(project.body, *mesh, modeling::meshRegions(project));
  const auto nodes = static_cast<double>(surface.positions.size());
  EXPECT_LE(expectedBytes({nodes, nodes}, modeling::Engine::kQuadratic, bem::Precision::kAutomatic),
            options.memoryLimit);
  for (const auto& finding : modeling::checkGeometry(surface, project.body))
    EXPECT_FALSE(finding.isError) << finding.message;
}

TEST(LargePart, OperatorsAreCompressedWhereOnlySoTheyFitIntoMemory) {
  const auto bytes = [](double nodes, bem::Precision precision) {
    return expectedBytes({nodes, nodes}, modeling::Engine::kQuadratic, precision);
  };
  const auto chosen = [](double nodes, double limit, bem::Precision wanted,
                         modeling::Engine engine = modeling::Engine::kQuadratic) {
    return fittingPrecision({nodes, nodes}, engine, wanted, limit);
  };
  using enum bem::Precision;
  const double between = 0.5 * (bytes(3000, kAutomatic) + bytes(3000, kCompressed));
  ASSERT_LT(bytes(3000, kCompressed), bytes(3000, kAutomatic));
  EXPECT_EQ(chosen(3000, between, kAutomatic), kCompressed);
  EXPECT_EQ(chosen(3000, 2 * between, kAutomatic), kAutomatic) << "both fit";
  EXPECT_EQ(chosen(3000, 0.1 * between, kAutomatic), kAutomatic) << "neither fits";
  EXPECT_EQ(chosen(3000, between, kSingle), kSingle) << "asked for";
  EXPECT_EQ(chosen(3000, between, kAutomatic, modeling::Engine::kTriangles), kAutomatic);

  modeling::Project sphere = test::clampedSphere(1.8);
  sphere.mesh.engine = modeling::Engine::kQuadratic;
  BuildOptions options;
  options.memoryLimit =
      1.15 * bytes(modeling::estimateNodeCount(sphere.body, sphere.mesh, {}), kCompressed);
  const auto model = buildTouchModel(sphere, options, {});
  EXPECT_LT(model->report().nodes, bem::kCompressedFrom);
  EXPECT_GT(bytes(model->report().nodes, kAutomatic), options.memoryLimit);
  EXPECT_EQ(model->report().storage, "compressed");
  EXPECT_LT(model->report().memory, options.memoryLimit);
}

TEST(LargePart, ModelsOfFewerNodesAreCompressedOnRequest) {
  modeling::Project sphere = test::clampedSphere(8);
  sphere.mesh.engine = modeling::Engine::kQuadratic;
  const auto storage = [&](std::optional<int> from) {
    BuildOptions options;
    options.compressedFrom = from;
    return buildTouchModel(sphere, options, {})->report().storage;
  };
  EXPECT_EQ(storage({}), "dense");
  EXPECT_EQ(storage(50), "compressed");
  EXPECT_EQ(storage(2000), "dense");
  sphere.mesh.engine = modeling::Engine::kTriangles;
  EXPECT_EQ(storage(50), "dense");

  // Leads and walls are less exact compressed.
  modeling::Project rod = test::clampedSphere(8);
  rod.mesh.engine = modeling::Engine::kQuadratic;
  rod.body = modeling::makeBox({60, 3, 3});
  rod.supports[0].where = modeling::Region::below(Eigen::Vector3d::UnitX(), 8);
  BuildOptions options;
  options.compressedFrom = 50;
  const auto model = buildTouchModel(rod, options, {});
  ASSERT_GT(model->report().nodes, 50);
  EXPECT_EQ(model->report().storage, "dense");
}

TEST(LargePart, TheSuggestionIsNothingIfNoMeshFits) {
  BuildOptions options;
  options.memoryLimit = 1000;  // bytes
  EXPECT_FALSE(suggestMesh(plate(), options, {}));
}

TEST(LargePart, ThePipelineAddsTheSuggestionToTheFailure) {
  modeling::Project project = plate();
  project.mesh.edgeLength = 1.5;
  BuildOptions options;
  options.memoryLimit =
      0.5 * expectedBytes({modeling::estimateNodeCount(project.body, project.mesh, {}), 0},
                          modeling::engineOf(project), bem::Precision::kAutomatic);
  RebuildPipeline pipeline(options);
  pipeline.submit(project);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!pipeline.status().reason.mesh && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const RebuildStatus status = pipeline.status();
  EXPECT_EQ(status.state, RebuildStatus::State::kFailed);
  ASSERT_TRUE(status.reason.mesh);
  EXPECT_GT(status.reason.mesh->edgeLength, project.mesh.edgeLength);
}

TEST(LargePart, AMeshThatCutsThroughItselfAsksForAnotherEdgeLength) {
  modeling::GeometryFinding finding;
  finding.message = "the surface intersects itself";
  const auto findings = std::make_shared<std::vector<modeling::GeometryFinding>>(1, finding);
  const std::string mesh = GeometryError(findings, plate().body).what();
  EXPECT_NE(mesh.find("edge length"), std::string::npos);
  EXPECT_EQ(mesh.find("control point"), std::string::npos);
}

TEST(CountText, SeparatesThousandsAndRoundsEstimates) {
  EXPECT_EQ(countText(0), "0");
  EXPECT_EQ(countText(999), "999");
  EXPECT_EQ(countText(1000), "1,000");
  EXPECT_EQ(countText(24512), "24,512");
  EXPECT_EQ(countText(-1234567.4), "-1,234,567");
  EXPECT_EQ(estimateText(24512), "24,500");
  EXPECT_EQ(estimateText(1234567), "1,230,000");
  EXPECT_EQ(estimateText(87.6), "88");
  EXPECT_EQ(countText(1e300), "more than a million billion");
}

}  // namespace
}  // namespace palpa::app

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "modeling/error.h"
#include "modeling/project/project_file.h"

// Files of older versions in data/projects/v<version>/ are fixtures: they are never written again.
namespace palpa::modeling {
namespace {

const std::filesystem::path kVersion1 = "data/projects/v1";
const std::filesystem::path kVersion2 = "data/projects/v2";

std::string errorOf(const std::string& text) {
  try {
    parseProject(text, "old.json");
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "no error";
}

/// Smooth edges of a project's solid, each as "patch|patch" in alphabetical order.
std::set<std::string> smoothEdges(const Project& project) {
  const auto& solid = std::get<Solid>(project.body);
  std::set<std::string> names;
  for (const SolidEdge& edge : solid.edges()) {
    const std::string& one = solid.patches()[edge.uses[0].patch].name;
    const std::string& other = solid.patches()[edge.uses[1].patch].name;
    if (edge.smooth) names.insert(std::min(one, other) + "|" + std::max(one, other));
  }
  return names;
}

TEST(ProjectMigration, EveryOldFileLoadsAndIsSavedInTheCurrentVersion) {
  int files = 0;
  for (const auto& folder : {kVersion1, kVersion2})
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string text = toJson(readProject(entry.path()));
      EXPECT_NE(text.find("\"version\": 3"), std::string::npos) << entry.path();
      EXPECT_EQ(toJson(parseProject(text, "again")), text) << entry.path();
      ++files;
    }
  EXPECT_GE(files, 7);
}

TEST(ProjectMigration, TheProbeOfVersion2IsABall) {
  const Project project = readProject(kVersion2 / "box.json");
  const Touch& ball = project.touches.at(1);
  EXPECT_EQ(ball.name, "roll a ball");
  EXPECT_EQ(ball.kind, TouchKind::kBall);
  EXPECT_EQ(ball.vector, Eigen::Vector3d(2, 0, -1));
  EXPECT_EQ(ball.friction, 0.3);
  std::string text = toJson(project);
  EXPECT_NE(text.find("\"kind\": \"ball\""), std::string::npos);
  text.replace(text.find("\"kind\": \"ball\""), 14, "\"kind\": \"probe\"");
  EXPECT_NE(errorOf(text).find("touches[1].kind: found \"probe\""), std::string::npos);
}

TEST(ProjectMigration, TheExamplesEqualTheirMigratedOldFiles) {
  for (const char* name : {"sphere.json", "cylinder.json", "box.json"}) {
    Project old = readProject(kVersion1 / name);
    const Project example = readProject(std::filesystem::path("../projects") / name);
    old.mesh.engine = example.mesh.engine;  // absent in version 1
    EXPECT_EQ(toJson(old), toJson(example)) << name;
  }
}

TEST(ProjectMigration, KeepsTheValuesOfVersion1) {
  const Project project = readProject(kVersion1 / "every_key.json");
  EXPECT_EQ(project.name, "box");
  EXPECT_EQ(project.material.youngsModulus, 1.5);
  EXPECT_EQ(std::get<Solid>(project.body).controlPoints().back(), Eigen::Vector3d(2, 1, 1));
  ASSERT_EQ(project.supports.size(), 2U);
  EXPECT_EQ(project.supports[1].displacement.z(), -0.001);
  ASSERT_EQ(project.loads.size(), 3U);
  EXPECT_EQ(std::get<Bump>(project.loads[2].what).peak, 0.02);
  ASSERT_EQ(project.touches.size(), 2U);
  EXPECT_EQ(project.mesh.refinementLevels, 2);
  EXPECT_EQ(project.view, R"({"zoom":1.5,"camera":[1,-2e-07,3],"flags":{"b":true,"a":null}})");
}

TEST(ProjectMigration, EdgesOfVersion1BelowTwoDegreesBecomeSmooth) {
  // The top of a block has a ridge of 1.9 or 2.1 degrees; its other three seams are flat.
  std::set<std::string> expected{"back_left|back_right", "bottom_left|bottom_right",
                                 "front_left|front_right"};
  EXPECT_EQ(smoothEdges(readProject(kVersion1 / "ridge_sharp.json")), expected);
  expected.insert("top_left|top_right");
  EXPECT_EQ(smoothEdges(readProject(kVersion1 / "ridge_smooth.json")), expected);

  EXPECT_TRUE(smoothEdges(readProject(kVersion1 / "box.json")).empty());
  EXPECT_EQ(smoothEdges(readProject(kVersion1 / "sphere.json")).size(), 12U);
  EXPECT_EQ(smoothEdges(readProject(kVersion1 / "cylinder.json")),
            (std::set<std::string>{"side_xmax|side_ymax", "side_xmax|side_ymin",
                                   "side_xmin|side_ymax", "side_xmin|side_ymin"}));
}

TEST(ProjectMigration, AVersion2FileSpecifiesItsSmoothEdges) {
  std::string text = toJson(readProject(kVersion1 / "sphere.json"));
  const std::size_t begin = text.find(",\n    \"smooth_edges\"");
  text.erase(begin, text.find("]\n", begin) + 1 - begin);
  EXPECT_TRUE(smoothEdges(parseProject(text, "test")).empty());
}

TEST(ProjectMigration, RefusesNewKeysInOldFilesAndNewVersions) {
  const std::string head = R"({"format": "palpa-project", "version": )";
  EXPECT_EQ(errorOf(head + R"(1, "primitive": {"kind": "sphere", "radius_mm": 2}})"),
            "old.json: primitive: unknown key in a file of version 1 (new in version 2)");
  EXPECT_EQ(errorOf(head + R"(1, "solid": {"smooth_edges": []}})"),
            "old.json: solid.smooth_edges: unknown key in a file of version 1 (new in version 2)");
  EXPECT_EQ(errorOf(head + R"(1, "mesh": {"patch_factors": {}}})"),
            "old.json: mesh.patch_factors: unknown key in a file of version 1 (new in version 2)");
  EXPECT_EQ(errorOf(head + R"(1, "mesh": {"edge_length_mm": 1, "accuracy": 0.1}})"),
            "old.json: mesh.accuracy: unknown key in a file of version 1 (new in version 2)");
  EXPECT_EQ(errorOf(head + "7}"),
            "old.json: version: found 7; this program reads up to version 3; a newer Palpa is "
            "needed");
  EXPECT_EQ(errorOf(head + "0}"),
            "old.json: version: found 0, expected a whole number from 1 to 3");
  EXPECT_EQ(errorOf(head + "1.5}"),
            "old.json: version: found 1.5, expected a whole number from 1 to 3");
  EXPECT_EQ(errorOf(head + "\"1\"}"),
            "old.json: version: found \"1\", expected a whole number from 1 to 3");
}

}  // namespace
}  // namespace palpa::modeling

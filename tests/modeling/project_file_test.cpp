#include "modeling/project/project_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;

Project example() {
  Project project;
  project.name = "Ball \"soft\" ü";
  auto& [material, youngsModulus, poissonRatio, density] = project.material;  // none its default
  material = "silicone";
  youngsModulus = 0.1;
  poissonRatio = 0.49;
  density = 1070;
  const Solid ball = makeSphere(25.0);
  project.body = ball.withSmoothEdges({1, 4, static_cast<int>(ball.edges().size()) - 1}, true);
  project.primitive = Primitive{SphereShape{25.0}, 3, 7};
  const Region base{{HalfSpace{{0, 0, 1}, -20.0}, PatchSet{{"bottom"}},
                     Stroke{{{0, 0, -25}, {1.0 / 3.0, 2, -24}}, 2.5}},
                    {Stroke{{{5, 0, -24}}, 1.5}, PatchSet{{"top"}}}};
  project.supports = {{"base", Support::Kind::kFixed, base, Eigen::Vector3d::Zero()},
                      {"guide", Support::Kind::kRoller, Region::ofPatches({"top"}), {0, 0, -1e-3}}};
  project.loads = {{"press", Pressure{Region::ofPatches({"side_xmax"}), 0.01}},
                   {"drag", UniformTraction{Region::below({1, 0, 0}, 3.0), {0.1, -0.0, 1.0 / 3.0}}},
                   {"finger", Bump{{0, 0, 25}, 4.0, 0.02, {0, 0, -1}}},
                   {"rope", TotalForce{Region::ofPatches({"top"}), {0.5, 0, -1.0 / 3.0}}},
                   {"key", Moment{Region::ofPatches({"top"}), {0, -2.5, 10}}},
                   {"weight", Gravity{}},
                   {"moon", Gravity{{0.1, 0, -1.625}}}};
  project.touches = {{"poke", {0, 0, 25}, TouchKind::kGrab, {0, 0, -2}, 3.0},
                     {"pull", {25, 0, 0}, TouchKind::kForce, {0.5, 0, 0}, std::nullopt},
                     {"slide", {0, 25, 0}, TouchKind::kPush, {1, -2, 0.1}, 5.0, 0.3},
                     {"ball", {0, -25, 0}, TouchKind::kBall, {0, 1.0 / 3.0, 0}, 7.5},
                     {"needle", {-25, 0, 0}, TouchKind::kPin, {0, 0, 0}, std::nullopt},
                     {"hook", {-20, 0, 15}, TouchKind::kPin, {0, 0, 1}, 2.0}};
  using What = MeasuredPlace::What;
  project.measurements = {{"height",
                           MeasurementKind::kDistance,
                           {{What::kPoint, "top", Eigen::Vector2d(1.0 / 3.0, 1)},
                            {What::kFace, "bottom", Eigen::Vector2d(0.5, 0.5)}}},
                          {"rim",
                           MeasurementKind::kLength,
                           {{What::kEdge, "top", Eigen::Vector2d(0, 0.5), Side::kUMin}}},
                          {"on a mesh",
                           MeasurementKind::kAngle,
                           {{What::kFace, "a", Eigen::Vector3d(1, 2, 1.0 / 3.0)},
                            {What::kEdge, "a", Eigen::Vector3d(1, 2, 3), {}, "b"}}}};
  Design& design = project.design.emplace();
  design.targets = {{"poke", DesignTarget::Kind::kStiffness, 1.0 / 3.0},
                    {"slide", DesignTarget::Kind::kForce, 0.7, 1.5, 2.0}};
  design.points = PointSelection{{AllOf{{PointSelection{{PatchPoints{{"top"}}}},
                                         PointSelection{{NoneOf{{PointSelection::of({3, 1})}}}}}}}};
  design.along = Design::Along::kDirection;
  design.direction = {0, 1.0 / 3.0, 1};
  design.largestMovement = 2.5;
  design.mirrors = {{{0, 0, 1.0 / 3.0}, {1, 0, 0}}};
  design.volume = Design::Volume::kNotLarger;
  design.smallestThickness = 1.0 / 3.0;
  design.smoothness = 0.3;
  design.tolerance = 0.01;
  design.steps = 7;
  project.mesh.edgeLength = 4.0;
  project.mesh.refinementLevels = 2;
  project.mesh.refineAtSharpEdges = project.mesh.refineAtBorders = true;
  project.mesh.patchFactors = {{"bottom", 1.0 / 3.0}, {"top", 0.5}};
  project.mesh.engine = Engine::kSplines;
  project.mesh.accuracy = 1.0 / 300;
  project.mesh.splineDensity = 4.0 / 3;
  project.mesh.elementLength = 2.5;
  project.view = R"({"zoom":1.5,"camera":[1,2,3],"about":{"b":1,"a":null}})";
  return project;
}

class ProjectFile : public testing::Test {
 protected:
  ProjectFile() {
    folder_ = fs::temp_directory_path() / ("palpa_project_test_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~ProjectFile() override { fs::remove_all(folder_); }

  static std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(ProjectFile, ALoadedProjectIsSavedWithTheSameBytes) {
  const std::string text = toJson(example());
  EXPECT_EQ(toJson(parseProject(text, "test")), text);
}

TEST_F(ProjectFile, KeepsEveryValue) {
  const Project before = example();
  const Project after = parseProject(toJson(before), "test");
  EXPECT_EQ(after.name, before.name);
  EXPECT_EQ(after.material, before.material);
  EXPECT_EQ(std::get<Solid>(after.body).controlPoints(),
            std::get<Solid>(before.body).controlPoints());
  EXPECT_EQ(after.supports, before.supports);
  EXPECT_EQ(after.loads, before.loads);
  EXPECT_EQ(after.touches, before.touches);
  EXPECT_EQ(after.measurements, before.measurements);
  EXPECT_EQ(after.design, before.design);
  EXPECT_EQ(after.mesh, before.mesh);
  EXPECT_EQ(after.primitive, before.primitive);
  const auto smooth = [](const Project& project) {
    std::vector<bool> flags;
    for (const SolidEdge& edge : std::get<Solid>(project.body).edges())
      flags.push_back(edge.smooth);
    return flags;
  };
  EXPECT_EQ(smooth(after), smooth(before));
  EXPECT_EQ(after.view, before.view);
}

TEST_F(ProjectFile, AGrabWithAForceIsTheForceItWasCalledAtFirst) {
  Project project = example();
  project.touches = {{"pull", {25, 0, 0}, TouchKind::kForce, {0.5, 0, 0}, 4.0}};
  project.design.reset();
  project.loads.clear();  // one of them is of the kind "force", too
  const std::string text = toJson(project);
  std::string old = text;
  const std::string kind = "\"kind\": \"force\"";
  ASSERT_NE(old.find(kind), std::string::npos);
  old.replace(old.find(kind), kind.size(), "\"kind\": \"grab\"");
  EXPECT_EQ(toJson(parseProject(old, "old.json")), text);
}

/// Tetrahedron with two faces whose triangles alternate.
Project tetrahedron() {
  MeshBody::Data data;
  data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.0 / 3.0}};
  data.triangles = {{0, 2, 1}, {3, 0, 1}, {2, 3, 1}, {0, 3, 2}};
  data.faceOfTriangle = {1, 0, 1, 1};
  data.faceNames = {"front", "others"};
  Project project;
  project.material = {"rubber", 1.5, 0.45};
  project.body = MeshBody(data);
  project.supports = {{"base", Support::Kind::kFixed, Region::ofPatches({"front"}), {0, 0, 0}}};
  project.mesh.patchFactors = {{"others", 2.0}};
  return project;
}

TEST_F(ProjectFile, KeepsAMeshBodyInItsOrder) {
  const Project before = tetrahedron();
  const std::string text = toJson(before);
  EXPECT_NE(text.find("{\"name\": \"others\", \"triangles\": [[0, 1], [2, 2]]}"), std::string::npos)
      << text;
  const Project after = parseProject(text, "test");
  const auto& body = std::get<MeshBody>(after.body);
  EXPECT_EQ(body.positions(), std::get<MeshBody>(before.body).positions());
  EXPECT_EQ(body.triangles(), std::get<MeshBody>(before.body).triangles());
  EXPECT_EQ(body.faceOfTriangle(), std::get<MeshBody>(before.body).faceOfTriangle());
  EXPECT_EQ(body.faceNames(), std::get<MeshBody>(before.body).faceNames());
  EXPECT_EQ(toJson(after), text);
}

TEST_F(ProjectFile, AcceptsAFileWithoutOptionalParts) {
  Project project = example();
  project.supports.clear();
  project.loads.clear();
  project.touches.clear();
  project.design.reset();
  project.view.clear();
  std::string text = toJson(project);
  for (const char* part : {"  \"supports\": [],\n", "  \"loads\": [],\n", "  \"touches\": [],\n"})
    text.erase(text.find(part), std::string(part).size());
  EXPECT_TRUE(parseProject(text, "test").supports.empty());
}

TEST_F(ProjectFile, SavesAndKeepsABackup) {
  const fs::path path = folder_ / "ball.json";
  Project project = example();
  writeProject(project, path);
  EXPECT_FALSE(fs::exists(folder_ / "ball.json.bak"));
  const std::string first = contentOf(path);
  project.name = "second";
  writeProject(project, path);
  EXPECT_EQ(contentOf(folder_ / "ball.json.bak"), first);
  EXPECT_EQ(readProject(path).name, "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
}

TEST_F(ProjectFile, AFailedSaveDoesNoHarm) {
  try {
    writeProject(example(), folder_ / "missing" / "ball.json");
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_EQ(error.kind(), ModelingError::Kind::kIo);
  }
  Project broken = example();
  const fs::path path = folder_ / "ball.json";
  writeProject(broken, path);
  const std::string good = contentOf(path);
  broken.material.youngsModulus = -1.0;
  EXPECT_THROW(writeProject(broken, path), ModelingError);
  EXPECT_EQ(contentOf(path), good);
}

TEST_F(ProjectFile, NamesAMissingFile) {
  try {
    readProject(folder_ / "none.json");
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_EQ(error.kind(), ModelingError::Kind::kNotFound);
    EXPECT_NE(std::string(error.what()).find("none.json: there is no such file"),
              std::string::npos);
  }
  EXPECT_THROW(readProject(folder_), ModelingError);
}

TEST_F(ProjectFile, NamesTheRegionsOfAMesh) {
  const std::vector<MeshRegion> regions = meshRegions(example());
  ASSERT_EQ(regions.size(), 6U);
  EXPECT_EQ(regions[0].name, "supports[0] \"base\"");
  EXPECT_EQ(regions[3].name, "loads[1] \"drag\"");
  EXPECT_FALSE(regions[3].isSupport);
  EXPECT_EQ(regions[5].name, "loads[4] \"key\"");
}

}  // namespace
}  // namespace palpa::modeling

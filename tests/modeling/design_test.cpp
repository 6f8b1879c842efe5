// The section "design" of project files: errors name the place, and commands keep it true.
#include "modeling/editing/command.h"
#include "modeling/project/project_file.h"
#include "tests/modeling/editing_fixture.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

Project boxWithDesign() {
  Project project = editingProject(makeBox({40, 30, 20}));
  project.supports.front().where = Region::ofPatches({"bottom"});
  project.touches.push_back({"press", {0, 0, 20}, TouchKind::kGrab, {0, 0, -1}, 3.0});
  Design& design = project.design.emplace();
  design.targets = {{"poke", DesignTarget::Kind::kStiffness, 0.5},
                    {"press", DesignTarget::Kind::kForce, 2.0, 1.5}};
  design.points = PointSelection{{PatchPoints{{"top", "side_xmin"}}}};
  design.mirrors = {{{0, 0, 0}, {1, 0, 0}}};
  return project;
}

std::string errorWith(const std::string& from, const std::string& to) {
  std::string text = toJson(boxWithDesign());
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "the text has no " + from;
  return faultOf([&] { parseProject(text.replace(at, from.size(), to), "box.json"); });
}

TEST(DesignFile, ErrorsNameThePathInTheFile) {
  EXPECT_EQ(errorWith(R"("touch": "press")", R"("touch": "presss")"),
            "box.json: design.targets[1].touch: no touch is named \"presss\"; the project has "
            "\"poke\", \"press\"");
  EXPECT_EQ(errorWith(R"("stiffness_N_per_mm": 0.5)", R"("stiffness_N_per_mm": 0)"),
            "box.json: design.targets[0].stiffness_N_per_mm: found 0, expected more than 0");
  EXPECT_EQ(errorWith(R"("force_N": 2)", R"("stiffness_N_per_mm": 2)"),
            "box.json: design.targets[1].depth_mm: belongs to a force, not to a stiffness");
  EXPECT_EQ(errorWith(R"("force_N": 2)", R"("force_N": 2, "stiffness_N_per_mm": 2)"),
            "box.json: design.targets[1]: expected either stiffness_N_per_mm or force_N, found "
            "both");
  EXPECT_EQ(errorWith(R"("points": {)", R"("smoothness": 200, "points": {)"),
            "box.json: design.smoothness: found 200, expected at most 100");
  EXPECT_EQ(errorWith(R"("points": {)", R"("along": "normals", "points": {)"),
            "box.json: design.along: found \"normals\", expected one of \"normal\", \"any\"");
  EXPECT_EQ(errorWith(R"("points": {)", R"("along": [0, 0, 0], "points": {)"),
            "box.json: design.along: the vector has the length 0; expected a direction");
  EXPECT_EQ(
      errorWith(R"("normal": [1, 0, 0]}])", R"("normal": [0, 0, 0]}])"),
      "box.json: design.mirrors[0].normal: the vector has the length 0; expected a direction");
  EXPECT_EQ(errorWith(R"("points": {)", R"("volumes": "kept", "points": {)")
                .rfind("box.json: design.volumes: unknown key", 0),
            0U);
}

TEST(DesignFile, DefaultsAreLeftOut) {
  Project project = boxWithDesign();
  project.design = Design{};
  const std::string text = toJson(project);
  EXPECT_NE(text.find("\"design\": {\n    \"targets\": []\n  }"), std::string::npos) << text;
  EXPECT_EQ(parseProject(text, "test").design, project.design);
}

TEST(DesignEdits, TargetsFollowTheirTouches) {
  const Project project = boxWithDesign();
  Touch renamed = project.touches.back();
  renamed.name = "thumb";
  const Project after = apply(SetTouch{"press", renamed}, project).project;
  EXPECT_EQ(after.design->targets[1].touch, "thumb");
  const Project removed = apply(RemoveTouch{"poke"}, project).project;
  ASSERT_EQ(removed.design->targets.size(), 1U);
  EXPECT_EQ(removed.design->targets[0].touch, "press");
}

TEST(DesignEdits, PointsFollowRenamedPatches) {
  const Project after = apply(RenamePatch{"top", "lid"}, boxWithDesign()).project;
  EXPECT_EQ(after.design->points, (PointSelection{{PatchPoints{{"lid", "side_xmin"}}}}));
}

TEST(DesignEdits, TransformationsKeepTheSelectedPoints) {
  Project project = boxWithDesign();
  project.design->points = PointSelection{{BoxPoints{{-20, -15, 19}, {20, 15, 21}}}};
  project.design->along = Design::Along::kDirection;
  project.design->direction = Vector3d::UnitX();
  const std::vector<int> selected = selectPoints(*project.design->points, solidOf(project));
  const Project turned =
      apply(TransformSolid{Rotation{Vector3d::UnitZ(), 90.0, Vector3d(5, 0, 0)}}, project).project;
  EXPECT_EQ(selectPoints(*turned.design->points, solidOf(turned)), selected);
  EXPECT_LT((turned.design->direction - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((turned.design->mirrors[0].normal - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(turned.design->mirrors[0].point.y(), -5, 1e-12);
}

TEST(DesignEdits, ADesignIsSetAndRemoved) {
  const Project project = boxWithDesign();
  EXPECT_FALSE(apply(SetDesign{}, project).project.design);
  Design wrong = *project.design;
  wrong.targets[0].touch = "nothing";
  expectBegins(faultOf([&] { apply(SetDesign{wrong}, project); }), "design.targets[0].touch: ");
}

}  // namespace
}  // namespace palpa::modeling

// Commands as JSON: every kind is read back, and errors name the location.
#include "modeling/editing/command_file.h"
#include "modeling/editing/command_names.h"
#include "tests/modeling/editing_fixture.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

std::vector<Command> oneOfEach() {
  const PointSelection some{{PointIndices{{1, 2}}, PatchPoints{{"top"}},
                             SidePoints{"top", Side::kUMax}, NetPoints{"top", {-1, std::nullopt}},
                             SlabPoints{{0, 0, 1}, 1.5, std::nullopt},
                             BoxPoints{{0, 0, 0}, {1, 1, 1.0 / 3.0}}, BallPoints{{1, 2, 3}, 4.5},
                             AllOf{{PointSelection::of({1, 2}), PointSelection::of({2, 3})}},
                             NoneOf{{PointSelection::of({4})}}}};
  const Reach reach{7.5, MirrorPlane{{1, 0, 0}, {1, 1, 0}}};
  const Support support{"wall", Support::Kind::kRoller, Region::ofPatches({"top"}), {0, 0, 0.1}};
  const Load load{"drag", UniformTraction{Region::below({1, 0, 0}, 3.0), {0.1, 0, 1.0 / 3.0}}};
  const Measurement height{
      "height",
      MeasurementKind::kDistance,
      {{MeasuredPlace::What::kPoint, "top", Eigen::Vector2d(0.25, 1)},
       {MeasuredPlace::What::kEdge, "bottom", Eigen::Vector2d(0, 0.5), Side::kUMin}}};
  const Touch touch{"poke", {0, 0, 20}, TouchKind::kGrab, {0, 0, -1}, 3.0};
  MeshSettings mesh;
  mesh.edgeLength = 3.0;
  mesh.patchFactors = {{"top", 0.5}};
  mesh.engine = Engine::kTriangles;
  mesh.accuracy = 0.003;
  mesh.splineDensity = 1.25;
  mesh.elementLength = 1.5;
  Design design;
  design.targets = {{"poke", DesignTarget::Kind::kForce, 1.0 / 3.0, 2.0}};
  design.points = some;
  design.mirrors = {*reach.mirror};
  return {MovePoints{some, MoveBy{{1, 2, 3}}, reach},
          MovePoints{PointSelection::of({1}), MoveTo{{{1, 2, 0.1}}}, {}},
          MovePoints{PointSelection::of({1}), MoveAlongNormal{-0.7}, {}},
          ScalePoints{some, {1, 2, 3}, Vector3d(1, 1, 1), reach},
          RotatePoints{some, {0, 1, 0}, 33.3, std::nullopt, reach},
          AlignPoints{some, Vector3d(0, 0, 1), 3.5},
          AlignPoints{some, std::nullopt, std::nullopt},
          InsertKnot{"top", 1, 0.3, 2},
          RemoveKnot{"top", 0, 0.3, 1, 0.01},
          ElevateDegree{"top", 0, 5},
          TransformSolid{Translation{{1, 2, 3}}},
          TransformSolid{Rotation{{0, 0, 1}, 45.0, {1, 0, 0}}},
          TransformSolid{Scaling{{1, 2, 3}, {1, 0, 0}}},
          TransformSolid{MirrorPlane{{0, 0, 0}, {1, 0, 0}}},
          MakePrimitive{{TorusShape{25.0, 8.0}, 3, 6}},
          SetEdge{"top", Side::kVMax, true},
          AddSupport{support},
          SetSupport{"base", support},
          RemoveSupport{"base"},
          TakeOverlap{"hand", "base", 1.5},
          AddLoad{load},
          SetLoad{"press", load},
          RemoveLoad{"press"},
          AddTouch{touch},
          SetTouch{"poke", touch},
          AddTouch{{"slide", {0, 0, 20}, TouchKind::kPush, {0, 1, -1}, {}, 0.25}},
          AddTouch{{"ball", {0, 0, 20}, TouchKind::kBall, {0, 0, -1}, 4.0, 0.1}},
          AddTouch{{"needle", {0, 0, 20}, TouchKind::kPin, {0, 0, 0}, {}}},
          AddTouch{{"pull", {0, 0, 20}, TouchKind::kForce, {0, 0, 1}, {}}},
          RemoveTouch{"poke"},
          AddMeasurement{height},
          SetMeasurement{"height", height},
          RemoveMeasurement{"height"},
          SetMaterial{{"rubber", 1.5, 0.49}},
          SetMaterial{{"rubber", 1.5, 0.49, 1150}},
          AddLoad{{"rope", TotalForce{Region::ofPatches({"top"}), {0, 0.5, 1.0 / 3.0}}}},
          AddLoad{{"key", Moment{Region::ofPatches({"top"}), {0, 0.5, 1.0 / 3.0}}}},
          AddLoad{{"weight", Gravity{}}},
          SetLoad{"weight", {"moon", Gravity{{0, 0, -1.625}}}},
          SetMesh{mesh},
          SetDesign{design},
          SetDesign{},
          RenameProject{"a \"new\" name"},
          RenamePatch{"top", "lid"}};
}

std::string faultOfText(const std::string& text) {
  return faultOf([&] { parseCommands(text, "edit.json"); });
}

TEST(CommandJson, EveryCommandReadsBack) {
  const std::vector<Command> commands = oneOfEach();
  std::vector<char> covered(kCommandNames.size(), 0);
  for (const Command& command : commands) {
    covered[command.index()] = 1;
    const std::vector<Command> read = parseCommands("[" + toJson(command) + "]", "test");
    ASSERT_EQ(read.size(), 1U);
    EXPECT_EQ(read[0].index(), command.index());
    EXPECT_EQ(toJson(read[0]), toJson(command));
    EXPECT_FALSE(label(command).empty());
  }
  EXPECT_EQ(std::count(covered.begin(), covered.end(), 0), 0);
  const std::string text = toJson(commands);
  EXPECT_EQ(toJson(parseCommands(text, "test")), text);
}

TEST(CommandJson, ReadsTheShortForms) {
  const auto commands = parseCommands(
      R"({"commands": [
        {"command": "scale_points", "points": {"patches": ["top"]}, "factor": 2},
        {"command": "move_points", "points": [1, {"net": {"patch": "top", "row": [0, "all"]}}, 2],
         "by_mm": [0, 0, 1]},
        {"command": "transform_solid", "scale": {"factor": 0.5}},
        {"command": "insert_knot", "patch": "top", "direction": "v", "at": 0.5}]})",
      "test");
  EXPECT_EQ(std::get<ScalePoints>(commands[0]).factors, Vector3d(2, 2, 2));
  const auto& points = std::get<MovePoints>(commands[1]).points;
  ASSERT_EQ(points.parts.size(), 2U);
  EXPECT_EQ(std::get<PointIndices>(points.parts[0]).indices, (std::vector{1, 2}));
  EXPECT_EQ(std::get<InsertKnot>(commands[3]).direction, 1);
  EXPECT_TRUE(parseCommands("[]", "test").empty());
}

TEST(CommandJson, ReadsTheFormerNameOfABall) {
  const std::string touch =
      R"("touch": {"name": "t", "kind": "probe", "at_mm": [0, 0, 20], "displace_mm": [0, 0, -1]}})";
  const auto commands =
      parseCommands(R"([{"command": "add_touch", )" + touch +
                        R"(, {"command": "set_touch", "name": "poke", )" + touch + "]",
                    "old.json");
  EXPECT_EQ(std::get<AddTouch>(commands[0]).touch.kind, TouchKind::kBall);
  EXPECT_EQ(std::get<SetTouch>(commands[1]).touch.kind, TouchKind::kBall);
}

TEST(CommandJson, ErrorsNameThePlace) {
  expectBegins(faultOfText(R"({"commands": [{"command": "mov"}]})"),
               "edit.json: commands[0].command: found \"mov\", expected one of \"move_points\"");
  expectBegins(faultOfText(R"([{"command": "rename_project", "name": "a"},
                               {"command": "move_points", "points": [1], "by_mm": "x"}])"),
               "edit.json: commands[1].by_mm: found \"x\", expected a list");
  expectBegins(faultOfText(R"([{"command": "move_points", "points": [1], "by_mm": [1, 2]}])"),
               "edit.json: commands[0].by_mm: found a list of 2, expected 3 entries");
  expectBegins(faultOfText(R"([{"command": "move_points", "points": [1]}])"),
               "edit.json: commands[0]: expected exactly one of by_mm, to_mm, along_normal_mm");
  expectBegins(faultOfText(R"([{"command": "move_points", "points": [1, -2], "by_mm": [0,0,1]}])"),
               "edit.json: commands[0].points[1]: found -2, expected at least 0");
  expectBegins(faultOfText(R"([{"command": "move_points", "points": {"patch": "top"}}])"),
               "edit.json: commands[0].points.patch: unknown key, expected one of");
  expectBegins(faultOfText(R"([{"command": "move_points", "points": [1], "bymm": [0,0,1]}])"),
               "edit.json: commands[0].bymm: unknown key, expected one of");
  expectBegins(faultOfText(R"([{"command": "insert_knot", "patch": "top", "direction": "w"}])"),
               "edit.json: commands[0].at: is missing");
  expectBegins(faultOfText(R"([{"command": "set_edge", "patch": "top", "side": "up",
                                "smooth": 1}])"),
               "edit.json: commands[0].side: found \"up\", expected one of \"u_min\"");
  expectBegins(faultOfText(R"([{"command": "set_edge", "patch": "top", "side": "u_min",
                                "smooth": 1}])"),
               "edit.json: commands[0].smooth: found 1, expected true or false");
  expectBegins(faultOfText(R"([{"command": "add_support", "support": {"name": "a", "kind": "glued",
                                "where": {"patches": ["top"]}}}])"),
               "edit.json: commands[0].support.kind: found \"glued\", expected one of \"fixed\"");
  expectBegins(faultOfText(R"([{"command": "set_material", "material": {"poisson_ratio": 0.3}}])"),
               "edit.json: commands[0].material.youngs_modulus_MPa: is missing");
  expectBegins(faultOfText(R"([{"command": "make_primitive",
                                "primitive": {"kind": "sphere", "radius_mm": -1}}])"),
               "edit.json: commands[0].primitive.radius_mm: found -1, expected more than 0");
  expectBegins(faultOfText(R"([{"command": "move_points",
                                "points": {"net": {"patch": "top", "row": [0, "any"]}},
                                "by_mm": [0, 0, 1]}])"),
               "edit.json: commands[0].points.net.row[1]: found \"any\", expected \"all\"");
  expectBegins(faultOfText(R"({"commands": [], "extra": 1})"), "edit.json: extra: unknown key");
  expectBegins(faultOfText("7"), "edit.json: the file: found 7, expected an object");
  expectBegins(faultOfText("[{"), "edit.json: line 1, column 3: the file ends too early");
  // The depth limit stops endlessly nested selections.
  std::string deep = "{\"patches\": [\"top\"]}";
  for (int k = 0; k < 40; ++k) deep = "{\"none_of\": [" + deep + "]}";
  EXPECT_NE(faultOfText("[{\"command\": \"move_points\", \"points\": " + deep +
                        ", \"by_mm\": [0, 0, 1]}]")
                .find("nested deeper than 32 levels"),
            std::string::npos);
}

}  // namespace
}  // namespace palpa::modeling

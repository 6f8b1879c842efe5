// palpa-cli edit.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliEdit : public testing::Test {
 protected:
  CliEdit() { cli_.run("new box --size 40,30,20 -o block.json"); }

  Runner cli_;
};

TEST_F(CliEdit, TheExampleOfTheDocumentationWorks) {
  std::stringstream page;
  page << std::ifstream(std::string(PALPA_PROJECTS) + "/../docs/editing.md").rdbuf();
  const std::string text = page.str();
  const std::size_t begin = text.find("```json\n") + 8;
  cli_.write("bulge.json", text.substr(begin, text.find("```", begin) - begin));
  const Json report = cli_.runJson("edit block.json --commands bulge.json -o bulged.json");
  ASSERT_EQ(report.at("commands").size(), 9U);
  EXPECT_EQ(report.at("commands")[1].at("changed")[0], "topology");
  EXPECT_EQ(report.at("commands")[7].at("label"), "Add load \"press\"");
  EXPECT_LT(report.at("largest_angle_across_smooth_edges_rad").get<double>(), 0.02);
  EXPECT_EQ(cli_.run("check bulged.json").exitCode, 0);
  const Json info = cli_.runJson("info bulged.json");
  EXPECT_GT(info.at("bounding_box_mm")[1][2].get<double>(), 22.0);
}

TEST_F(CliEdit, WritesOnlyWhereAsked) {
  cli_.write("c.json", R"([{"command": "rename_project", "name": "renamed"}])");
  const std::string before = cli_.read("block.json");
  EXPECT_EQ(cli_.run("edit block.json --commands c.json").exitCode, 2);
  EXPECT_EQ(cli_.run("edit block.json --commands c.json --in-place -o x.json").exitCode, 2);
  EXPECT_EQ(cli_.read("block.json"), before);
  const Outcome done = cli_.run("edit block.json --commands c.json --in-place");
  EXPECT_EQ(done.exitCode, 0) << done.err;
  EXPECT_NE(done.out.find("Rename project: name changed"), std::string::npos) << done.out;
  EXPECT_EQ(cli_.readJson("block.json").at("name"), "renamed");
}

TEST_F(CliEdit, ContradictingSupportsAreEndedByACommand) {
  cli_.write("add.json", R"([{"command": "set_mesh",
      "mesh": {"edge_length_mm": 5, "engine": "triangles"}},
      {"command": "add_support", "support": {"name": "hand", "kind": "fixed", "where":
      {"stroke": {"points_mm": [[0, 13, 0]], "radius_mm": 6}},
      "displacement_mm": [0, 1, 0]}}])");
  cli_.run("edit block.json --commands add.json --in-place");
  const Outcome refused = cli_.run("solve block.json");
  EXPECT_EQ(refused.exitCode, 3) << refused.err;
  EXPECT_NE(refused.err.find("supports \"base\" and \"hand\" overlap near"), std::string::npos)
      << refused.err;
  cli_.write("take.json",
             R"([{"command": "take_overlap", "name": "hand", "from": "base", "gap_mm": 2}])");
  EXPECT_EQ(cli_.run("edit block.json --commands take.json --in-place").exitCode, 0);
  EXPECT_EQ(cli_.run("solve block.json").exitCode, 0);
  const Outcome info = cli_.run("info block.json");
  EXPECT_NE(info.out.find(", except within 8 mm of (0, 13, 0)"), std::string::npos) << info.out;
}

TEST_F(CliEdit, NamesTheCommandThatIsRefused) {
  const auto errorOf = [&](const std::string& commands) {
    cli_.write("c.json", commands);
    const Outcome outcome = cli_.run("edit block.json --commands c.json -o out.json");
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(cli_.path("out.json")));
    return outcome.err;
  };
  EXPECT_EQ(errorOf(R"([{"command": "rename_project", "name": "a"},
                        {"command": "move_points", "points": [1], "by_mm": "x"}])"),
            "palpa-cli: c.json: commands[1].by_mm: found \"x\", expected a list\n");
  EXPECT_EQ(errorOf(R"([{"command": "rename_project", "name": "a"},
                        {"command": "move_points", "points": [99], "by_mm": [0, 0, 1]}])"),
            "palpa-cli: c.json: commands[1] (Move 1 control point): points[0]: control point 99 "
            "does not exist; the solid has 56 (0 … 55)\n");
  EXPECT_EQ(errorOf(R"([{"command": "remove_support", "name": "wall"}])"),
            "palpa-cli: c.json: commands[0] (Remove support \"wall\"): name: no support is named "
            "\"wall\"; there are \"base\"\n");
  EXPECT_EQ(cli_.run("edit block.json --commands missing.json -o out.json").exitCode, 3);
}

}  // namespace
}  // namespace palpa::cli_tests

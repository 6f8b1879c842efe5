// palpa-cli measure.
#include <gtest/gtest.h>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliMeasure : public testing::Test {
 protected:
  CliMeasure() { cli_.run("new box -o box.json"); }  // 40 x 30 x 20 mm on z = 0
  Json first(const std::string& arguments) {
    return cli_.runJson("measure " + arguments).at("measurements").at(0);
  }
  Runner cli_;
};

TEST_F(CliMeasure, MeasuresABox) {
  EXPECT_NEAR(first("box.json --distance face:side_xmin face:side_xmax")["distance_mm"], 40, 1e-6);
  EXPECT_NEAR(first("box.json --distance -20,-15,0 20,15,20")["distance_mm"], 53.85164807, 1e-6);
  EXPECT_NEAR(first("box.json --length edge:20,0,20")["length_mm"], 30, 1e-6);
  EXPECT_NEAR(first("box.json --angle face:top face:side_ymin")["angle_deg"], 90, 1e-6);
  EXPECT_NEAR(first("box.json --angle 20,-15,20 -20,-15,20 -20,-15,0")["angle_deg"], 90, 1e-6);
  const Json wall = first("box.json --thickness 0,0,20");
  EXPECT_NEAR(wall["thickness_mm"], 20, 1e-6);
  EXPECT_NEAR(wall["ball_diameter_mm"], 20, 1e-4);
  EXPECT_TRUE(first("box.json --radius 0,0,20")["radius_mm"].is_null()) << "flat";
  const Json body = cli_.runJson("measure box.json");
  EXPECT_NEAR(body["volume_mm3"], 24000, 1e-6);
  EXPECT_NEAR(body["area_mm2"], 2 * (1200 + 800 + 600), 1e-6);
  EXPECT_NE(
      cli_.run("measure box.json --distance face:top face:bottom").out.find("distance 1: 20 mm"),
      std::string::npos);
}

TEST_F(CliMeasure, MeasuresRoundBodiesOfBothKinds) {
  cli_.run("new cylinder --radius 15 --height 40 -o c.json");
  const Json side = first("c.json --radius 15,0,20");
  EXPECT_NEAR(side["radius_mm"], 15, 0.3) << "a cubic with few points approximates the circle";
  EXPECT_FALSE(side.contains("fit"));
  cli_.run("export c.json -o c.stl");
  ASSERT_EQ(cli_.run("import c.stl -o mesh.json").exitCode, 0);
  const Json mesh = first("mesh.json --radius 15,0,20");
  EXPECT_EQ(mesh["fit"], "cylinder");
  EXPECT_NEAR(mesh["radius_mm"], 15, 0.05);
  EXPECT_NEAR(first("mesh.json --distance 0,0,40 face:0,0,0")["distance_mm"], 40, 1e-3);
  const Json rim = first("mesh.json --radius edge:15,0,40");
  EXPECT_EQ(rim["fit"], "circle");
  EXPECT_NEAR(rim["radius_mm"], 15, 0.05);
}

TEST_F(CliMeasure, StoresMeasurementsThatFollowEdits) {
  ASSERT_EQ(cli_.run("measure box.json --distance face:bottom face:top -o m.json").exitCode, 0);
  cli_.write("edit.json", R"([{"command": "transform_solid", "scale": {"factors": [1, 1, 2]}}])");
  ASSERT_EQ(cli_.run("edit m.json --commands edit.json -o e.json").exitCode, 0);
  EXPECT_NEAR(first("e.json")["distance_mm"], 40, 1e-6);
  cli_.write("gone.json", R"([{"command": "make_primitive", "primitive": {"kind": "torus",
      "major_radius_mm": 25, "minor_radius_mm": 8}}])");
  // The support of the box has no place on a torus either.
  Json project = cli_.readJson("m.json");
  project["supports"] = Json::array();
  cli_.writeJson("m.json", project);
  const Outcome made = cli_.run("edit m.json --commands gone.json -o g.json");
  ASSERT_EQ(made.exitCode, 0) << made.err;
  EXPECT_NE(first("g.json").at("problem").get<std::string>().find("measure again"),
            std::string::npos);
}

TEST_F(CliMeasure, RefusesWhatIsNoPlaceByItsOption) {
  for (const auto& [arguments, words] :
       {std::pair{"--distance face:lid face:top", "--distance: no patch is named 'lid'"},
        std::pair{"--length face:top", "a length belongs to an edge"},
        std::pair{"--radius edge:top/left", "--radius: expected edge:x,y,z or edge:PATCH/SIDE"},
        std::pair{"--thickness top", "--thickness: expected"},
        std::pair{"--radius point:1,2,3", "--radius: expected x,y,z, face:… or edge:…"},
        std::pair{"-o p.json", "--output: there is nothing to add"}}) {
    const Outcome outcome = cli_.run(std::string("measure box.json ") + arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace palpa::cli_tests

// palpa-cli new, info, check, mesh.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliProject : public testing::Test {
 protected:
  Runner cli_;
};

TEST_F(CliProject, NewMakesValidProjectsWithNamedPatches) {
  for (const char* primitive :
       {"sphere --radius 25", "cylinder --radius 20 --height 60", "box --size 40,30,20"}) {
    const Outcome made = cli_.run(std::string("new ") + primitive + " -o p.json");
    EXPECT_EQ(made.exitCode, 0) << made.err;
    const Json project = cli_.readJson("p.json");
    EXPECT_EQ(project.at("format"), "palpa-project");
    EXPECT_EQ(project.at("version"), 1);
    std::string names;
    for (const Json& patch : project.at("solid").at("patches")) {
      names += patch.at("name").get<std::string>() + " ";
    }
    EXPECT_NE(names.find("top"), std::string::npos) << names;
    EXPECT_NE(names.find("bottom"), std::string::npos) << names;
    EXPECT_NE(names.find("side"), std::string::npos) << names;
    EXPECT_EQ(cli_.run("check p.json").exitCode, 0);
  }
}

TEST_F(CliProject, CheckFindsAControlPointPulledThroughTheOtherSide) {
  cli_.run("new sphere --radius 25 --edge-length 5 -o p.json");
  EXPECT_EQ(cli_.runJson("check p.json").at("geometry"), Json::array());
  Json project = cli_.readJson("p.json");
  Json& points = project.at("solid").at("control_points_mm");
  std::size_t top = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i][2].get<double>() > points[top][2].get<double>()) top = i;
  }
  points[top] = {0, 0, -150};
  cli_.writeJson("p.json", project);
  const Outcome outcome = cli_.run("check p.json --json");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(outcome.err.find("the geometry has"), std::string::npos) << outcome.err;
  const Json report = outcome.json();
  EXPECT_EQ(report.at("valid"), false);
  bool found = false;
  for (const Json& finding : report.at("geometry")) {
    if (finding.at("kind") != "self_intersection") continue;
    found = true;
    EXPECT_EQ(finding.at("severity"), "error");
    EXPECT_EQ(finding.at("at_mm").size(), 3U);
    EXPECT_FALSE(finding.at("triangles").empty());
    EXPECT_EQ(finding.at("patches").back(), "top");
  }
  EXPECT_TRUE(found) << report;
  const Outcome text = cli_.run("check p.json");
  EXPECT_EQ(text.exitCode, 3);
  EXPECT_NE(text.out.find("error      the surface cuts through itself near ("), std::string::npos);
}

TEST_F(CliProject, NewWithoutAFileWritesTheProjectToStandardOutput) {
  EXPECT_EQ(cli_.run("new box").json().at("format"), "palpa-project");
}

TEST_F(CliProject, NewPlacesSolidsAsDocumented) {
  const auto boxOf = [&](const std::string& arguments) {
    cli_.run("new " + arguments + " -o p.json");
    return cli_.runJson("info p.json");
  };
  const Json box = boxOf("box --size 40,30,20");
  const Json corners = Json::parse("[[-20, -15, 0], [20, 15, 20]]");
  for (int corner = 0; corner < 2; ++corner) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(box.at("bounding_box_mm")[corner][i].get<double>(),
                  corners[corner][i].get<double>(), 1e-12);
    }
  }
  EXPECT_NEAR(box.at("volume_mm3").get<double>(), 24000, 1e-6);
  // The spline sphere and cylinder deviate by about 1e-4.
  const Json sphere = boxOf("sphere --radius 25");
  EXPECT_NEAR(sphere.at("volume_mm3").get<double>(), 4.0 / 3 * std::numbers::pi * 15625, 10);
  const Json cylinder = boxOf("cylinder --radius 20 --height 60");
  EXPECT_NEAR(cylinder.at("volume_mm3").get<double>(), std::numbers::pi * 24000, 20);
  EXPECT_NEAR(cylinder.at("bounding_box_mm")[0][2].get<double>(), 0, 1e-9);
}

TEST_F(CliProject, NewRefusesWhatMakesNoSense) {
  for (const char* arguments :
       {"new pyramid", "new", "new sphere --radius -3", "new sphere --radius nan",
        "new sphere --radius 1e999", "new sphere --height 3", "new box --size 1,2",
        "new box --size 1,2,0", "new box --size 1,2,3,4", "new sphere --no-such-option"}) {
    const Outcome outcome = cli_.run(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_EQ(outcome.err.rfind("palpa-cli: ", 0), 0u) << arguments << ": " << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  }
  const Outcome unknown = cli_.run("new pyramid");
  EXPECT_NE(unknown.err.find("pyramid"), std::string::npos);
  EXPECT_NE(unknown.err.find("sphere"), std::string::npos);
  EXPECT_EQ(cli_.run("new sphere -o no/such/folder/p.json").exitCode, 3);
  EXPECT_EQ(cli_.run("new sphere --poisson-ratio 0.7").exitCode, 3);
}

TEST_F(CliProject, InfoSpeaksOfEverything) {
  cli_.run("new cylinder -o p.json");
  const Outcome outcome = cli_.run("info p.json");
  EXPECT_EQ(outcome.exitCode, 0);
  for (const char* word : {"cylinder", "silicone", "bottom", "base", "edge length", "volume"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
}

TEST_F(CliProject, MeshWritesEveryFormatAndReportsItsQuality) {
  cli_.run("new sphere -o p.json");
  for (const char* name : {"m.stl", "m.obj", "m.ply", "m.vtp"}) {
    const Json report = cli_.runJson(std::string("mesh p.json --edge-length 6 -o ") + name);
    EXPECT_GT(report.at("nodes").get<int>(), 100);
    EXPECT_GT(report.at("quality").at("smallest_angle_degrees").get<double>(), 20);
    // Euler's formula for a closed surface without holes: triangles = 2 (nodes - 2).
    EXPECT_EQ(report.at("triangles").get<int>(), 2 * (report.at("nodes").get<int>() - 2));
    EXPECT_GT(std::filesystem::file_size(cli_.path(name)), 1000u) << name;
  }
  EXPECT_EQ(cli_.run("mesh p.json -o m.step").exitCode, 3);
  EXPECT_EQ(cli_.run("mesh p.json -o no/such/folder/m.stl").exitCode, 3);
  EXPECT_EQ(cli_.run("mesh p.json --edge-length 0").exitCode, 2);
}

TEST_F(CliProject, AMeshTooFineForTheMachineIsRefusedWithTheNumber) {
  cli_.run("new sphere -o p.json");
  const Outcome outcome = cli_.run("mesh p.json --edge-length 0.0001");
  EXPECT_EQ(outcome.exitCode, 4);
  EXPECT_NE(outcome.err.find("nodes"), std::string::npos) << outcome.err;
}

TEST_F(CliProject, HelpHasAnExampleForEachCommand) {
  EXPECT_EQ(cli_.run("--help").exitCode, 0);
  EXPECT_EQ(cli_.run("--version").exitCode, 0);
  EXPECT_EQ(cli_.run("").exitCode, 2);
  EXPECT_EQ(cli_.run("frobnicate").exitCode, 2);
  for (const char* command : {"new", "info", "check", "mesh", "solve", "touch", "render"}) {
    const Outcome help = cli_.run(std::string(command) + " --help");
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_NE(help.out.find(std::string("palpa-cli ") + command), std::string::npos) << help.out;
    EXPECT_NE(help.out.find("Example"), std::string::npos) << help.out;
  }
}

}  // namespace
}  // namespace palpa::cli_tests

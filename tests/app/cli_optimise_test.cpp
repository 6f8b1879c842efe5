// palpa-cli optimise: what it writes, what it refuses, and how it ends.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

const std::string kBox = std::string(PALPA_PROJECTS) + "/box.json";

double stiffnessIn(const Json& touched, const std::string& name) {
  for (const Json& contact : touched["contacts"])
    if (contact["name"] == name) return contact["stiffness_N_per_mm"];
  return 0;
}

TEST(CliOptimise, WritesAShapeThatTouchConfirms) {
  const Runner cli;
  const Json json = cli.runJson(
      "optimise " + kBox + " --target \"press the top=1.25\" --largest-movement 5 -o out.json");
  EXPECT_EQ(json["reached"], true);
  EXPECT_EQ(json["file"], "out.json");
  EXPECT_TRUE(json["limits"].empty());
  ASSERT_EQ(json["targets"].size(), 1);
  EXPECT_NEAR(json["targets"][0]["before_N_per_mm"], 1.16, 0.02);
  EXPECT_NEAR(json["targets"][0]["after_N_per_mm"], 1.25, 0.00625);
  EXPECT_GT(json["steps"].size(), 1);
  EXPECT_NEAR(stiffnessIn(cli.runJson("touch out.json"), "press the top"), 1.25, 0.0125);
  // The design is stored, so that a second search has nothing to do.
  EXPECT_EQ(cli.readJson("out.json")["design"]["targets"][0]["stiffness_N_per_mm"], 1.25);
  EXPECT_EQ(cli.runJson("optimise out.json")["moved_points"], 0);
}

TEST(CliOptimise, AnImpossibleTargetWritesNothing) {
  const Runner cli;
  const std::string call =
      "optimise " + kBox + " --target \"press the top=50\" --largest-movement 1 -o out.json";
  const Outcome outcome = cli.run(call);
  EXPECT_EQ(outcome.exitCode, 4);
  EXPECT_NE(outcome.out.find("limit      the largest movement of 1 mm"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("cannot be reached"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(cli.path("out.json")));
  // The nearest shape is written when it is asked for, and it is stiffer.
  const Outcome nearest = cli.run(call + " --nearest --json");
  EXPECT_EQ(nearest.exitCode, 4);
  EXPECT_EQ(nearest.json()["reached"], false);
  EXPECT_EQ(nearest.json()["limits"][0]["kind"], "movement");
  EXPECT_GT(
      stiffnessIn(cli.runJson("touch out.json --accuracy 0.003"), "press the top"),
      1.005 * stiffnessIn(cli.runJson("touch " + kBox + " --accuracy 0.003"), "press the top"));
}

TEST(CliOptimise, RefusesWrongInput) {
  const Runner cli;
  const auto expect = [&](const std::string& options, int code, const std::string& message) {
    const Outcome outcome = cli.run("optimise " + kBox + " " + options);
    EXPECT_EQ(outcome.exitCode, code) << options << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  expect("--target \"press=1\"", 3, "design.targets[0].touch: no touch is named \"press\"");
  expect("", 3, "design.targets: there is no target");
  expect("--target \"press the top\"", 2, "--target: expected NAME=STIFFNESS");
  expect("--target \"press the top=1N/mm@3\"", 2, "a depth belongs to a force");
  expect("--target \"press the top=-1\"", 2, "expected a number greater than zero");
  expect("--target \"pull the corner region=1N\"", 3, "states its force");
  expect("--target \"press the top=1\" --move lid", 3, "no patch is named \"lid\"");
  expect("--target \"press the top=1\" --mirror x=3", 3, "has no mirror image");
  expect("--target \"press the top=1\" --mirror w", 2, "--mirror: expected");
  expect("--target \"press the top=1\" --volume constant", 2, "--volume: expected free, kept");
  expect("--target \"press the top=1\" --points 1,x", 2, "--points: expected numbers");
  expect("--target \"press the top=1\" --nearest", 2, "--nearest needs -o");
  cli.run("new box -o plain.json");
  const Outcome none = cli.run("optimise plain.json --target \"poke=1\"");
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_NE(none.err.find("the project has no touches"), std::string::npos) << none.err;
}

TEST(CliOptimise, ReadsForcesDepthsAndPoints) {
  const Runner cli;
  const Json json = cli.runJson(
      "optimise " + kBox +
      " --target \"press the top=1.8 N@1.5 mm\" --move top --move side_xmin --stay side_ymax "
      "--along 0,0,1 --smoothness 2 --tolerance 0.01 -o out.json");
  EXPECT_NEAR(json["targets"][0]["after_N"], 1.8, 0.018);
  EXPECT_EQ(json["targets"][0]["depth_mm"], 1.5);
  const Json design = cli.readJson("out.json")["design"];
  EXPECT_EQ(design["along"], Json({0, 0, 1}));
  EXPECT_EQ(design["smoothness"], 2);
  // Points of side_ymax have not moved, and no point moved sideways.
  const Json before = Json::parse(cli.read(kBox)), after = cli.readJson("out.json");
  const Json &from = before["solid"]["control_points_mm"],
             &to = after["solid"]["control_points_mm"];
  int moved = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(from[i][0], to[i][0]);
    EXPECT_EQ(from[i][1], to[i][1]);
    moved += from[i] != to[i];
  }
  EXPECT_GT(moved, 0);
  for (const Json& patch : before["solid"]["patches"]) {
    if (patch["name"] != "side_ymax") continue;
    for (const Json& row : patch["net"])
      for (const Json& index : row)
        EXPECT_EQ(from[index.get<std::size_t>()], to[index.get<std::size_t>()]);
  }
}

TEST(CliOptimise, FixedPatchesStayWhenOthersMustStay) {
  const Runner cli;
  cli.run("optimise " + kBox +
          " --target \"press the top=2\" --stay side_xmin --max-steps 1 --nearest -o out.json");
  const Json box = Json::parse(cli.read(kBox)), after = cli.readJson("out.json");
  const Json &from = box["solid"]["control_points_mm"], &to = after["solid"]["control_points_mm"];
  int moved = 0;
  for (const Json& patch : box["solid"]["patches"])
    for (const Json& row : patch["net"])
      for (const Json& index : row) {
        const auto k = index.get<std::size_t>();
        moved += from[k] != to[k];
        if (patch["name"] == "bottom" || patch["name"] == "side_xmin") {
          EXPECT_EQ(from[k], to[k]) << patch["name"];
        }
      }
  EXPECT_GT(moved, 0);
}

TEST(CliOptimise, AnInterruptLeavesNothing) {
  const Runner cli;
  const std::string out = cli.path("out.json").string();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(PALPA_CLI, "palpa-cli", "optimise", kBox.c_str(), "--target", "press the top=3",
          "--accuracy", "0.001", "-o", out.c_str(), "--quiet", static_cast<char*>(nullptr));
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace palpa::cli_tests

// Every kind of bad input: a clear message, the right exit code, never a crash.
#include <gtest/gtest.h>

#include <functional>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

struct BadInput {
  const char* name;
  std::function<void(Json&)> spoil;
  int exitCode;
  std::vector<const char*> words;  ///< that the message must contain
};

void PrintTo(const BadInput& input, std::ostream* stream) {
  *stream << input.name;
}

class CliBadProject : public testing::TestWithParam<BadInput> {};

TEST_P(CliBadProject, IsRefused) {
  const Runner cli;
  cli.run("new box --size 40,30,20 --edge-length 8 -o p.json");
  Json project = cli.readJson("p.json");
  GetParam().spoil(project);
  cli.writeJson("p.json", project);
  for (const char* command : {"solve p.json", "check p.json"}) {
    const Outcome outcome = cli.run(command);
    EXPECT_EQ(outcome.exitCode, GetParam().exitCode) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("palpa-cli: ", 0), 0u) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const char* word : GetParam().words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in " << outcome.err;
    }
  }
  const Outcome asJson = cli.run("solve p.json --json");
  EXPECT_EQ(asJson.exitCode, GetParam().exitCode);
  EXPECT_EQ(asJson.json().at("error").at("exit_code"), GetParam().exitCode);
}

const Json kEverySide =
    Json::parse(R"(["top","bottom","side_xmin","side_xmax","side_ymin","side_ymax"])");

INSTANTIATE_TEST_SUITE_P(
    Kinds, CliBadProject,
    testing::Values(
        BadInput{"no_supports", [](Json& p) { p["supports"] = Json::array(); }, 4, {"not fixed"}},
        BadInput{"held_only_partly",
                 [](Json& p) { p["supports"][0]["kind"] = "roller"; },
                 4,
                 {"x", "y", "z"}},
        BadInput{"all_clamped_incompressible",
                 [](Json& p) {
                   p["material"]["poisson_ratio"] = 0.5;
                   p["supports"][0]["where"] = {{"patches", kEverySide}};
                 },
                 4,
                 {"0.5"}},
        BadInput{"knots_in_disorder",
                 [](Json& p) { p["solid"]["patches"][2]["knots"][0][5] = -0.4; },
                 3,
                 {"solid.patches[2].knots[0]"}},
        BadInput{"wrong_net_size",
                 [](Json& p) { p["solid"]["patches"][1]["net"].erase(0); },
                 3,
                 {"solid.patches[1]"}},
        BadInput{"null_coordinate",  // what JSON writers make of NaN
                 [](Json& p) { p["solid"]["control_points_mm"][3][1] = nullptr; },
                 3,
                 {"solid.control_points_mm[3]"}},
        BadInput{"unknown_patch",
                 [](Json& p) {
                   p["supports"][0]["where"] = {{"patches", Json::array({"lid"})}};
                 },
                 3,
                 {"lid", "supports[0]"}},
        BadInput{"poisson_ratio",
                 [](Json& p) { p["material"]["poisson_ratio"] = 0.6; },
                 3,
                 {"poisson_ratio"}},
        BadInput{"newer_version", [](Json& p) { p["version"] = 99; }, 3, {"version"}},
        BadInput{"wrong_type", [](Json& p) { p["solid"] = "sphere"; }, 3, {"solid"}}),
    [](const auto& instance) { return instance.param.name; });

TEST(CliBadInput, FilesThatAreNoProjects) {
  const Runner cli;
  cli.write("nan.json", R"({"format": "palpa-project", "version": NaN})");
  cli.write("empty.json", "");
  cli.write("binary.json", std::string("\0\x01\x02\xff", 4));
  cli.write("deep.json", std::string(100000, '['));
  std::filesystem::create_directory(cli.path("folder"));
  for (const char* file :
       {"nan.json", "empty.json", "binary.json", "deep.json", "folder", "missing.json"}) {
    for (const char* command :
         {"info ", "check ", "mesh ", "solve ", "touch ", "render -o a.png "}) {
      const Outcome outcome = cli.run(std::string(command) + file);
      EXPECT_EQ(outcome.exitCode, 3) << command << file << "\n" << outcome.err;
      EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    }
  }
}

TEST(CliBadInput, ASampleFarFromTheSurface) {
  const Runner cli;
  cli.run("new box --edge-length 8 -o p.json");
  const Outcome outcome = cli.run("solve p.json --sample 500,0,0");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(outcome.err.find("500"), std::string::npos) << outcome.err;
}

TEST(CliBadInput, AnEdgeLengthThatWouldNeedTooMuchMemoryIsRefusedWithTheNumber) {
  const Runner cli;
  cli.run("new sphere --radius 25 -o p.json");
  // About 60,000 nodes: (3n)² numbers of 4 bytes are over 100 GB.
  const Outcome triangles = cli.run("solve p.json --engine triangles --edge-length 0.4");
  EXPECT_EQ(triangles.exitCode, 4);
  EXPECT_NE(triangles.err.find("GiB"), std::string::npos) << triangles.err;
  EXPECT_NE(triangles.err.find("nodes"), std::string::npos) << triangles.err;
  const Outcome splines = cli.run("solve p.json --engine spline --element-length 0.4");
  EXPECT_EQ(splines.exitCode, 4);
  EXPECT_NE(splines.err.find("GiB"), std::string::npos) << splines.err;
}

}  // namespace
}  // namespace palpa::cli_tests

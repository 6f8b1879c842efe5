// palpa-cli touch --place auto, and commands on CAD and mesh files without a project.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

std::string foreign(const std::string& name) {
  return PALPA_TEST_DATA "/cad/" + name;
}

class CliPlace : public testing::Test {
 protected:
  void SetUp() override { cli_.run("new box --size 20,16,12 --edge-length 3 -o b.json"); }

  void removeSupports() const {
    Json project = cli_.readJson("b.json");
    project["supports"] = Json::array();
    cli_.writeJson("free.json", project);
  }

  Runner cli_;
  const double size_ = std::sqrt(20 * 20 + 16 * 16 + 12 * 12);  // diagonal, mm
};

TEST_F(CliPlace, IsOppositeToTheSupportAndPressedByAShareOfTheSize) {
  const Json report = cli_.runJson("touch b.json --place auto --depth 1%");
  const Json& place = report.at("place");
  EXPECT_NEAR(place.at("at_mm")[2].get<double>(), 12, 1e-9);
  EXPECT_NEAR(place.at("direction")[2].get<double>(), -1, 1e-9);
  EXPECT_NEAR(place.at("depth_mm").get<double>(), 0.01 * size_, 1e-9);
  EXPECT_FALSE(report.contains("proposed_support"));
  const Json& contact = report.at("contacts")[0];
  EXPECT_EQ(contact.at("kind"), "grab");
  EXPECT_NEAR(contact.at("displacement_mm")[2].get<double>(), -0.01 * size_, 1e-9);
  EXPECT_GT(contact.at("normal_force_N").get<double>(), 0.01);
  EXPECT_LT(report.at("relative_balance").get<double>(), 0.02);
}

TEST_F(CliPlace, TheDepthIsALengthOrAShareAndOnePercentWithoutOne) {
  const auto force = [&](const std::string& options) {
    return cli_.runJson("touch b.json --place auto " + options)
        .at("contacts")[0]
        .at("normal_force_N")
        .get<double>();
  };
  const double one = force("");
  EXPECT_NEAR(force("--depth 2%"), 2 * one, 1e-6 * one);
  EXPECT_NEAR(force("--depth 0.3"), 0.3 / (0.01 * size_) * one, 1e-6 * one);
}

TEST_F(CliPlace, TakesTheOptionsOfATouch) {
  const Json pushed =
      cli_.runJson("touch b.json --place auto --depth 1% --kind push --radius 4 --friction 0.3");
  EXPECT_EQ(pushed.at("contacts")[0].at("kind"), "push");
  EXPECT_EQ(pushed.at("contacts")[0].at("radius_mm"), 4);
  EXPECT_GT(pushed.at("contacts")[0].at("normal_force_N").get<double>(), 0);
  const Json pulled = cli_.runJson("touch b.json --place auto --force 0,0,0.5");
  EXPECT_EQ(pulled.at("contacts")[0].at("kind"), "force");
  EXPECT_FALSE(pulled.at("place").contains("depth_mm"));
  EXPECT_EQ(cli_.run("touch b.json --place auto --depth 1% --sweep 2 -o curve.csv").exitCode, 0);
  EXPECT_NE(cli_.read("curve.csv").find('\n'), std::string::npos);
}

TEST_F(CliPlace, ProposesASupportWhereThereIsNone) {
  removeSupports();
  const Json report = cli_.runJson("touch free.json --place auto");
  EXPECT_EQ(report.at("proposed_support").at("faces"), Json::parse(R"(["bottom"])"));
  EXPECT_EQ(report.at("supports")[0].at("name"), "base");
  EXPECT_NEAR(report.at("place").at("at_mm")[2].get<double>(), 12, 1e-9);
  const Outcome text = cli_.run("touch free.json --place auto");
  EXPECT_NE(text.out.find("the largest flat face, \"bottom\""), std::string::npos) << text.out;
  // Without --place nothing is proposed.
  EXPECT_EQ(cli_.run("touch free.json --at 0,0,12 --displace 0,0,-1").exitCode, 4);
}

TEST_F(CliPlace, TouchesCadAndMeshFilesWithoutAProject) {
  cli_.run("export b.json -o b.step");
  cli_.run("export b.json -o b.stl --edge-length 4");
  for (const std::string& file :
       {std::string("b.step"), std::string("b.stl"), foreign("bored_cylinder.step")}) {
    const Json report = cli_.runJson("touch " + file + " --place auto --depth 1%");
    EXPECT_GT(report.at("contacts")[0].at("normal_force_N").get<double>(), 0) << file;
    EXPECT_EQ(report.at("import").at("kind"), file == "b.step" ? "solid" : "mesh body");
    EXPECT_EQ(report.at("proposed_support").at("faces").size(), 1u) << file;
  }
}

/// Text STL of an axis-parallel cube around the origin, with normals outwards or inwards.
std::string cube(double half, bool isOutwards) {
  static constexpr int kCorners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                          {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                          {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  std::ostringstream text;
  for (const auto& corners : kCorners) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int k : {0, isOutwards ? 1 : 2, isOutwards ? 2 : 1}) {
      text << "vertex";
      for (const int bit : {1, 2, 4}) text << ' ' << ((corners[k] & bit) ? half : -half);
      text << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  return text.str();
}

TEST_F(CliPlace, ABodyWithACavityGetsAMaterialThatCanBeComputed) {
  cli_.write("hollow.stl", "solid hollow\n" + cube(10, true) + cube(5, false) + "endsolid\n");
  const Json report = cli_.runJson("touch hollow.stl --place auto --edge-length 4");
  EXPECT_NEAR(report.at("import").at("volume_mm3").get<double>(), 8000 - 1000, 1e-6);
  EXPECT_NE(report.at("import").at("notes")[0].get<std::string>().find("closed cavity"),
            std::string::npos);
  EXPECT_NEAR(report.at("place").at("at_mm")[2].get<double>(), 10, 1e-9) << "on the outside";
  EXPECT_LT(report.at("relative_balance").get<double>(), 0.05);
  cli_.run("import hollow.stl -o hollow.json");
  EXPECT_EQ(cli_.readJson("hollow.json").at("material").at("poisson_ratio"), 0.45);
}

TEST_F(CliPlace, ALimitOfTheProcessIsNamedBeforeItIsReached) {
  // 20,000 unknowns need more than 3 GiB; prlimit belongs to every Debian.
  const Outcome refused = cli_.run("touch b.json --place auto --engine triangles --edge-length 0.5",
                                   "prlimit --as=3000000000");
  EXPECT_EQ(refused.exitCode, 4) << refused.err;
  EXPECT_NE(refused.err.find("GiB can be used"), std::string::npos) << refused.err;
}

TEST_F(CliPlace, OtherCommandsReadCadAndMeshFilesToo) {
  cli_.run("export b.json -o b.step");
  EXPECT_EQ(cli_.runJson("check b.step").at("valid"), true);
  EXPECT_GT(cli_.runJson("mesh b.step --edge-length 4").at("nodes").get<int>(), 50);
  const Outcome info = cli_.run("info " + foreign("bored_cylinder.step"));
  EXPECT_EQ(info.exitCode, 0);
  EXPECT_NE(info.err.find("has a hole"), std::string::npos) << "notes: " << info.err;
  EXPECT_TRUE(cli_.run("info -q " + foreign("bored_cylinder.step")).err.empty());
}

TEST_F(CliPlace, RefusesOptionsWithoutMeaning) {
  for (const char* options :
       {"--place top", "--place auto --at 0,0,12 --displace 0,0,-1", "--place auto --node 3",
        "--depth 1%", "--at 0,0,12 --displace 0,0,-1 --depth 1%", "--place auto --depth -1%",
        "--place auto --depth deep", "--place auto --depth 0",
        "--place auto --depth 1% --displace 0,0,-1", "--place auto --depth 1% --kind force",
        "--place auto --depth 1% --kind pin", "--place auto --kind force"}) {
    const Outcome outcome = cli_.run(std::string("touch b.json ") + options);
    EXPECT_EQ(outcome.exitCode, 2) << options << ": " << outcome.err;
  }
}

TEST_F(CliPlace, TheMeshIsRefinedUntilTheForcesHaveTheWishedError) {
  cli_.run("new box --size 20,16,12 --edge-length 8 -o coarse.json");
  const std::string touch = "touch coarse.json --engine quadratic --place auto";
  const Json coarse = cli_.runJson(touch);
  EXPECT_FALSE(coarse.contains("refinement"));
  const double wished = coarse.at("force_error_estimate").get<double>() / 2;
  const Json fine = cli_.runJson(touch + " --force-error " + std::to_string(100 * wished) + "%");
  EXPECT_LE(fine.at("force_error_estimate").get<double>(), wished);
  const Json& refinement = fine.at("refinement");
  EXPECT_EQ(refinement.at("end"), "reached");
  ASSERT_GE(refinement.at("meshes").size(), 2u);
  const Json& first = refinement.at("meshes").front();
  const Json& last = refinement.at("meshes").back();
  EXPECT_EQ(first.at("nodes"), coarse.at("nodes"));
  EXPECT_EQ(first.at("force_error_estimate"), coarse.at("force_error_estimate"));
  EXPECT_EQ(first.at("edge_length_mm"), 8);
  EXPECT_LT(last.at("edge_length_mm").get<double>(), 8);
  EXPECT_EQ(refinement.at("taken"), refinement.at("meshes").size() - 1);
  EXPECT_EQ(last.at("nodes"), fine.at("nodes"));
  // The place stays.
  EXPECT_EQ(fine.at("place"), coarse.at("place"));

  const Json hurried = cli_.runJson(touch + " --force-error 0.001% --time-limit 0.001");
  EXPECT_EQ(hurried.at("refinement").at("end"), "time");
  EXPECT_EQ(hurried.at("nodes"), coarse.at("nodes"));
  const Outcome text = cli_.run(touch + " --force-error 0.001% --time-limit 0.001");
  EXPECT_NE(text.out.find("longer than the 0.001 s of --time-limit"), std::string::npos)
      << text.out;
}

TEST_F(CliPlace, AWishedErrorIsAShareBelowOne) {
  for (const char* bad : {"0", "-1%", "100%", "1", "much"})
    EXPECT_EQ(cli_.run(std::string("touch b.json --place auto --force-error ") + bad).exitCode, 2)
        << bad;
  EXPECT_EQ(cli_.run("touch b.json --place auto --time-limit 5").exitCode, 2);
  EXPECT_EQ(cli_.run("touch b.json --place auto --force-error 5% --time-limit 0").exitCode, 2);
  EXPECT_EQ(cli_.run("touch b.json --recording r.json --force-error 5%").exitCode, 2);
  EXPECT_EQ(cli_.run("touch b.json --node 3 --displace 0,0,-1 --force-error 5%").exitCode, 2);
}

}  // namespace
}  // namespace palpa::cli_tests

// palpa-cli import, export, convert.
#include <gtest/gtest.h>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

/// Files of other programs.
std::string foreign(const std::string& name) {
  return PALPA_TEST_DATA "/cad/" + name;
}

class CliExchange : public testing::Test {
 protected:
  Runner cli_;
};

TEST_F(CliExchange, ASolidComesBackFromEveryCadFormat) {
  cli_.run("new sphere --radius 25 -o ball.json");
  const Json solid = cli_.readJson("ball.json").at("solid");
  for (const char* name : {"ball.step", "ball.iges", "ball.brep"}) {
    const Json written = cli_.runJson(std::string("export ball.json -o ") + name);
    EXPECT_EQ(written.at("kind"), "solid");
    const Json read = cli_.runJson(std::string("import ") + name + " -o back.json --name again");
    EXPECT_EQ(read.at("name"), "again");
    EXPECT_EQ(read.at("control_points"), written.at("control_points"));
    EXPECT_EQ(read.at("patches"), written.at("patches"));
    EXPECT_TRUE(read.at("notes").empty()) << read.at("notes");
    const Json back = cli_.readJson("back.json").at("solid");
    ASSERT_EQ(back.at("control_points_mm").size(), solid.at("control_points_mm").size());
    for (std::size_t i = 0; i < back.at("control_points_mm").size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(back.at("control_points_mm")[i][k].get<double>(),
                    solid.at("control_points_mm")[i][k].get<double>(), 25e-9);
      }
    }
    EXPECT_EQ(cli_.run("check back.json").exitCode, 0);
  }
}

TEST_F(CliExchange, ForeignFilesAreApproximatedAndSaySo) {
  const Outcome outcome = cli_.run("import " + foreign("quarter_pipe_inch.step") + " -o pipe.json");
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("solid      6 patches"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("note       Approximated"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("deviation"), std::string::npos) << outcome.out;
  // Radii 10 and 16 mm, height 25 mm, whatever the unit of the file.
  const Json info = cli_.runJson("info pipe.json");
  EXPECT_NEAR(info.at("volume_mm3").get<double>(), 3063.05, 0.5);
  EXPECT_EQ(info.at("supports")[0].at("name"), "base");
  EXPECT_EQ(cli_.run("check pipe.json").exitCode, 0);

  const Json finer = cli_.runJson("convert " + foreign("quarter_pipe_inch.step") +
                                  " -o pipe.brep --tolerance 1e-5");
  EXPECT_LT(finer.at("deviation_mm").get<double>(), 1e-5);
}

TEST_F(CliExchange, AnImportedMeshBodyIsSavedCheckedAndTouched) {
  const Json imported = cli_.runJson("import " + foreign("bored_cylinder.step") + " -o bored.json");
  EXPECT_EQ(imported.at("kind"), "mesh body");
  EXPECT_FALSE(imported.at("notes").empty());
  EXPECT_TRUE(cli_.runJson("check bored.json").at("valid"));
  const Json touched = cli_.runJson("touch bored.json --at 20,0,25 --displace -1,0,0");
  EXPECT_LT(touched.at("contacts")[0].at("force_N")[0].get<double>(), -0.1);
  EXPECT_LE(touched.at("relative_balance").get<double>(), 0.01);
}

TEST_F(CliExchange, MeshBodiesSayWhyAndAreWrittenAsTriangles) {
  for (const char* name : {"b.stl", "b.obj", "b.ply"}) {
    const Json report =
        cli_.runJson("convert " + foreign("bored_cylinder.step") + " -o " + std::string(name));
    EXPECT_EQ(report.at("kind"), "mesh body");
    EXPECT_GT(report.at("triangles").get<int>(), 100);
    EXPECT_NE(report.at("notes")[0].get<std::string>().find("has a hole"), std::string::npos);
    EXPECT_GT(std::filesystem::file_size(cli_.path(name)), 1000u);
  }
  const Outcome refused = cli_.run("convert " + foreign("bored_cylinder.step") + " -o b.igs");
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_NE(refused.err.find("STL, OBJ or PLY"), std::string::npos) << refused.err;
}

TEST_F(CliExchange, SolidsBecomeMeshesOfTheAskedSize) {
  cli_.run("new box --size 20,20,20 -o b.json");
  cli_.runJson("export b.json -o coarse.stl");
  cli_.runJson("export b.json -o fine.stl --edge-length 1");
  EXPECT_GT(std::filesystem::file_size(cli_.path("fine.stl")),
            3 * std::filesystem::file_size(cli_.path("coarse.stl")));
}

TEST_F(CliExchange, MistakesHaveTheirExitCodes) {
  cli_.run("new box -o b.json");
  cli_.write("bad.step", "solid cube\n");
  const auto code = [&](const std::string& arguments) { return cli_.run(arguments).exitCode; };
  EXPECT_EQ(code("import b.json -o c.json"), 2);
  EXPECT_EQ(code("export b.json -o c.json"), 2);
  EXPECT_EQ(code("export b.json"), 2);
  EXPECT_EQ(code("import bad.step --tolerance -1"), 2);
  EXPECT_EQ(code("import bad.step"), 3);
  EXPECT_EQ(code("import none.step"), 3);
  EXPECT_EQ(code("import none.xyz"), 3);
  EXPECT_EQ(code("convert b.json -o b.xyz"), 3);
  EXPECT_EQ(code("export b.json -o no/such/folder/b.step"), 3);
  EXPECT_EQ(code("convert " + foreign("bored_cylinder.step") + " -o b.stl --edge-length 1e-5"), 4);
  // Standard output holds only the report, without messages of OpenCASCADE.
  EXPECT_TRUE(cli_.run("import bad.step").out.empty());
}

}  // namespace
}  // namespace palpa::cli_tests

// palpa-cli section, and sections in pictures.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliSection : public testing::Test {
 protected:
  CliSection() { cli_.run("new box --edge-length 8 -o p.json"); }
  Runner cli_;
};

TEST_F(CliSection, ReportsAndWritesTheFieldOnAPlane) {
  const Json json =
      cli_.runJson("section p.json --section z=10 --at 0,0,20 --displace 0,0,-1 -o s.csv");
  EXPECT_NEAR(json.at("area_mm2").get<double>(), 40 * 30, 1);
  EXPECT_GT(json.at("displacement_mm").at("value").get<double>(), 0.01);
  EXPECT_GT(json.at("von_mises_MPa").at("value").get<double>(), 0);
  EXPECT_LT(json.at("smallest_principal_MPa").at("value").get<double>(), 0) << "pressed";
  const std::string table = cli_.read("s.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), json.at("points").get<int>() + 1);
  EXPECT_EQ(
      cli_.run("section p.json --section 0,0,2,20 --at 0,0,20 --force 0,0,-1 -o s.vtp").exitCode,
      0);
  EXPECT_NE(cli_.read("s.vtp").find("stress_MPa"), std::string::npos);
}

TEST_F(CliSection, TakesAwayEitherSide) {
  const Json one = cli_.runJson("section p.json --section x=5 --at 0,0,20 --force 0,0,-1"),
             other = cli_.runJson("section p.json --section=-x=5 --at 0,0,20 --force 0,0,-1");
  EXPECT_EQ(other.at("normal")[0], -1);
  EXPECT_NEAR(one.at("displacement_mm").at("value").get<double>(),
              other.at("displacement_mm").at("value").get<double>(), 1e-3);
}

TEST_F(CliSection, RefusesWhatIsNoPlane) {
  for (const char* arguments :
       {"", "--section w=3", "--section x", "--section x=a", "--section 0,0,0,1", "--section 1,0,2",
        "--section x=100", "--section x=0 -o s.stl", "--section x=0 -o s.txt"}) {
    const Outcome outcome = cli_.run(std::string("section p.json ") + arguments);
    EXPECT_NE(outcome.exitCode, 0) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  EXPECT_EQ(cli_.run("section p.json --section x=100 --at 0,0,20 --force 0,0,-1").exitCode, 2);
}

TEST_F(CliSection, IsDrawnInPicturesWithAFixedRange) {
  const std::string touch = "--at 0,0,20 --displace 0,0,-1 --size 320x240 -o a.png ";
  for (const char* arguments : {"--section y=0 --field von-mises --range 0,0.01 --extremes",
                                "--section=-z=10", "--section 1,1,0,3 --field normal-traction",
                                "--section x=0 --field none", "--section x=500"})
    EXPECT_EQ(cli_.run("render p.json " + touch + arguments, PALPA_WITH_DISPLAY).exitCode, 0)
        << arguments;
  for (const char* arguments : {"--range 1", "--range 2,1", "--range a,b",
                                "--range -1,1 --field stiffness", "--section q=1"})
    EXPECT_EQ(cli_.run("render p.json " + touch + arguments, PALPA_WITH_DISPLAY).exitCode, 2)
        << arguments;
}

}  // namespace
}  // namespace palpa::cli_tests

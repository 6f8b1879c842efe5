// Profiles from drawings: palpa-cli new --profile with SVG and DXF files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

const std::string kDrawings = PALPA_TEST_DATA "/drawings/";

class CliDrawings : public testing::Test {
 protected:
  double volumeOf(const std::string& project) const {
    return cli_.runJson("info " + project)["volume_mm3"].get<double>();
  }

  Runner cli_;
};

TEST_F(CliDrawings, AnOutlineBecomesASolid) {
  const Json made = cli_.runJson("new extrude --profile " + kDrawings +
                                 "plate.dxf --layer outline --height 8 -o plate.json");
  EXPECT_GT(made["drawing_deviation_mm"].get<double>(), 0.0);
  EXPECT_LE(made["drawing_deviation_mm"].get<double>(), 0.007);
  const double area = 60 * 40 - (4 - std::numbers::pi) * 64;
  EXPECT_NEAR(volumeOf("plate.json"), 8 * area, 8 * area * 1e-3);
  cli_.runJson("new extrude --profile " + kDrawings + "bracket.svg --curve 2 -o hole.json");
  EXPECT_NEAR(volumeOf("hole.json"), 20 * std::numbers::pi * 24, 2.0);
  EXPECT_EQ(
      cli_.runJson("new revolve --profile " + kDrawings + "bottle.dxf -o b.json")["primitive"],
      "revolve");
  // A profile that is no drawing has no deviation from one.
  EXPECT_FALSE(cli_.runJson("new extrude --profile " PALPA_PROJECTS "/profiles/sole.json -o s.json")
                   .contains("drawing_deviation_mm"));
}

TEST_F(CliDrawings, TheToleranceDecidesOnTheControlPoints) {
  const auto points = [&](const std::string& options) {
    return cli_
        .runJson("new extrude --profile " + kDrawings + "plate.dxf --curve 2 -o p.json " +
                 options)["control_points"]
        .get<int>();
  };
  EXPECT_LT(points("--fit-tolerance 0.1"), points("--fit-tolerance 0.001"));
}

TEST_F(CliDrawings, AChoiceIsListedAndErrorsHaveTheirExitCode) {
  const Outcome choice = cli_.run("new extrude --profile " + kDrawings + "plate.dxf -o p.json");
  EXPECT_EQ(choice.exitCode, 3);
  EXPECT_NE(choice.err.find("choose one by its number or its layer: 1: closed, 60 × 40 mm"),
            std::string::npos)
      << choice.err;
  EXPECT_EQ(cli_.run("new extrude --profile " + kDrawings + "bottle.dxf -o p.json").exitCode, 3);
  EXPECT_EQ(cli_.run("new loft --profile " + kDrawings + "slot.dxf -o p.json").exitCode, 2);
  EXPECT_EQ(cli_.run("new sphere --curve 2 -o p.json").exitCode, 2);
  EXPECT_EQ(
      cli_.run("new extrude --curve 2 --profile " PALPA_PROJECTS "/profiles/sole.json").exitCode,
      2);
  cli_.write("cut.svg", "<svg xmlns='http://www.w3.org/2000/svg'><path d='M 0 0 L 5 5");
  EXPECT_EQ(cli_.run("new extrude --profile cut.svg -o p.json").exitCode, 3);
  EXPECT_FALSE(std::filesystem::exists(cli_.path("p.json")));
}

}  // namespace
}  // namespace palpa::cli_tests

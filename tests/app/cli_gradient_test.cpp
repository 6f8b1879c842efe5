// palpa-cli gradient.
#include <gtest/gtest.h>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

TEST(CliGradient, PrintsARowPerControlPoint) {
  Runner cli;
  const std::string box = std::string(PALPA_PROJECTS) + "/box.json";
  const Json json = cli.runJson("gradient " + box);
  ASSERT_EQ(json["touches"].size(), 2);
  const Json& touch = json["touches"][0];
  EXPECT_EQ(touch["name"], "press the top");
  EXPECT_NEAR(touch["stiffness_N_per_mm"], 1.16, 0.02);
  ASSERT_EQ(touch["gradient_N_per_mm2"].size(), 56);
  for (int c = 0; c < 3; ++c) {
    double sum = 0;
    for (const Json& row : touch["gradient_N_per_mm2"]) sum += row[c].get<double>();
    EXPECT_NEAR(sum, 0, 1e-6) << "a translation changes nothing";
  }
  EXPECT_NEAR(json["body"]["volume_mm3"], 24000, 1e-3);
  EXPECT_NE(cli.run("gradient " + box).out.find("N/mm per mm"), std::string::npos);
}

TEST(CliGradient, RefusesBodiesWithoutControlPointsOrTouches) {
  Runner cli;
  cli.run("new box -o box.json");
  const Outcome none = cli.run("gradient box.json");
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_NE(none.err.find("no touches"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace palpa::cli_tests

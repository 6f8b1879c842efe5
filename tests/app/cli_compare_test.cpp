// palpa-cli compare.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliCompare : public testing::Test {
 protected:
  CliCompare() {
    cli_.run("new sphere --radius 25 -o a.json");
    cli_.run("new sphere --radius 26 -o b.json");
  }
  static const Json& row(const Json& report, const std::string& figure) {
    for (const Json& each : report.at("rows"))
      if (each.at("figure") == figure) return each;
    throw std::runtime_error("no row " + figure);
  }
  Runner cli_;
};

TEST_F(CliCompare, ReportsBothVariantsUnderTheSameTouch) {
  const std::string touch = " --at 0,0,25 --kind ball --displace 0,0,-2 --radius 6 ";
  const Json json = cli_.runJson("compare a.json b.json" + touch + "-o table.csv");
  const Json& carried = json.at("touches").at(0);
  // From the sphere of 25 mm to the sphere of 26 mm; the mesh lies a little inside.
  EXPECT_NEAR(carried.at("carried_mm").get<double>(), 1, 0.05);
  EXPECT_FALSE(carried.at("turned").get<bool>());
  EXPECT_NEAR(row(json, "volume_mm3").at("relative_difference").get<double>(),
              std::pow(26.0 / 25, 3) - 1, 1e-6);
  const Json& force = row(json, "force_N");
  // The same touch on A alone.
  const Json alone = cli_.runJson("touch a.json" + touch);
  const Json& vector = alone.at("contacts").at(0).at("force_N");
  const double size =
      std::hypot(vector[0].get<double>(), vector[1].get<double>(), vector[2].get<double>());
  EXPECT_NEAR(force.at("a").get<double>(), size, 1e-9 * size);
  EXPECT_NEAR(force.at("difference").get<double>(),
              force.at("b").get<double>() - force.at("a").get<double>(), 1e-12);
  EXPECT_GT(force.at("relative_error_a").get<double>(), 0);
  EXPECT_NEAR(json.at("corresponding_share").get<double>(), 1, 1e-9);
  const std::string table = cli_.read("table.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')),
            json.at("rows").size() + 1);
  const Outcome text = cli_.run("compare a.json b.json" + touch);
  EXPECT_EQ(text.exitCode, 0);
  for (const char* words : {"Force, N", "Largest von Mises stress, MPa", "Volume, mm³", "B - A"})
    EXPECT_NE(text.out.find(words), std::string::npos) << words << "\n" << text.out;
}

TEST_F(CliCompare, PlaysTheTouchesOfTheFirstProject) {
  const Json json = cli_.runJson("compare " PALPA_PROJECTS "/sphere.json b.json");
  EXPECT_EQ(json.at("touches").size(), 1u);
  EXPECT_EQ(cli_.runJson("compare b.json " PALPA_PROJECTS "/sphere.json").at("touches").size(), 0u);
}

TEST_F(CliCompare, RefusesWhatCannotBeCompared) {
  EXPECT_EQ(cli_.run("compare a.json").exitCode, 2);
  EXPECT_EQ(cli_.run("compare a.json b.json --node 3 --displace 1,0,0").exitCode, 2);
  EXPECT_EQ(cli_.run("compare a.json b.json -o table.txt").exitCode, 2);
  const Outcome absent = cli_.run("compare a.json absent.json");
  EXPECT_EQ(absent.exitCode, 3);
  EXPECT_NE(absent.err.find("absent.json"), std::string::npos);
  // A touch on the support, and a body without one: the message names the file.
  const Outcome fixed = cli_.run("compare a.json b.json --at 0,0,-25 --displace 0,0,1 --radius 1");
  EXPECT_EQ(fixed.exitCode, 3);
  EXPECT_NE(fixed.err.find("a.json: "), std::string::npos) << fixed.err;
}

}  // namespace
}  // namespace palpa::cli_tests

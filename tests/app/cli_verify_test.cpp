// palpa-cli verify: the report, wrong references, wrong names.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

Json readReference(const std::string& name) {
  std::ifstream file(PALPA_REFERENCE "/" + name);
  return Json::parse(file);
}

Json& caseOf(Json& reference, const std::string& id) {
  for (Json& entry : reference["cases"])
    if (entry["id"] == id) return entry;
  throw std::runtime_error("no case " + id);
}

/// A folder with changed reference data.
template <class Spoil>
void writeReference(const Runner& cli, const std::string& name, const Spoil& spoil) {
  for (const char* file : {"analytic.json", "fem.json"}) {
    Json reference = readReference(file);
    if (file == name) spoil(reference);
    cli.writeJson(file, reference);
  }
}

TEST(CliVerify, TheShortRunReportsEveryCheckAndPasses) {
  const Runner cli;
  const Json report = cli.runJson("verify --quick");
  EXPECT_EQ(report.at("pass"), true);
  EXPECT_EQ(report.at("failed"), 0);
  int checks = 0, triangles = 0, splines = 0, series = 0;
  for (const Json& result : report.at("results")) {
    EXPECT_EQ(result.at("pass"), true) << result;
    EXPECT_GT(result.at("n"), 0) << result;
    triangles += result.at("engine") == "triangles";
    splines += result.at("engine") == "splines";
    for (const Json& check : result.at("checks")) {
      ++checks;
      EXPECT_EQ(check.at("pass"), true) << result;
      if (check.contains("tolerance")) {
        EXPECT_LE(check.at("error"), check.at("tolerance")) << result;
        EXPECT_GE(check.at("error"), 0) << result;
      } else {
        EXPECT_GE(check.at("value"), check.at("least")) << result;
      }
    }
    if (!result.contains("steps")) continue;
    ++series;
    EXPECT_EQ(result.at("steps").size(), 3);
    EXPECT_FALSE(result.at("steps").at(0).contains("order"));
    EXPECT_GT(result.at("steps").at(2).at("order"), 1.5);
  }
  EXPECT_EQ(checks, report.at("checks"));
  EXPECT_GE(triangles, 6);
  EXPECT_GE(splines, 7);
  EXPECT_EQ(series, 2);
}

TEST(CliVerify, TheTableHasALinePerResultAndWithAllPerCheck) {
  const Runner cli;
  const std::string arguments = "verify --engine triangles --case cylinder_tension_nu0.30 ";
  const Outcome shortOne = cli.run(arguments), longOne = cli.run(arguments + "--all");
  ASSERT_EQ(shortOne.exitCode, 0) << shortOne.err;
  const auto lines = [](const Outcome& outcome, const std::string& with) {
    int count = 0;
    for (std::size_t at = 0; (at = outcome.out.find(with, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(lines(shortOne, "\ncylinder_tension_nu0.30  triangles  stated"), 1) << shortOne.out;
  EXPECT_EQ(lines(longOne, "\ncylinder_tension_nu0.30  triangles  stated"), 4) << longOne.out;
  EXPECT_EQ(lines(longOne, "splines"), 0);
  EXPECT_NE(longOne.out.find("All 5 checks"), std::string::npos) << longOne.out;
}

TEST(CliVerify, AChangedNumberOfAnExactCaseFails) {
  const Runner cli;
  const std::string id = "patch_linear_box_nu0.30";
  writeReference(cli, "analytic.json", [&](Json& reference) {
    Json& x = caseOf(reference, id)["points"][3]["u"][0];
    x = x.get<double>() + 0.01;
  });
  const Outcome asJson = cli.run("verify --json --reference . --case " + id);
  EXPECT_EQ(asJson.exitCode, 4) << asJson.err;
  const Json report = asJson.json();
  EXPECT_EQ(report.at("pass"), false);
  // The file against itself, triangles with the stated and with mixed data, splines.
  EXPECT_EQ(report.at("failed"), 4);
  for (const Json& result : report.at("results")) EXPECT_EQ(result.at("pass"), false) << result;
  const Outcome asText = cli.run("verify --reference . --case " + id);
  EXPECT_EQ(asText.exitCode, 4);
  EXPECT_NE(asText.out.find("FAIL"), std::string::npos) << asText.out;
  EXPECT_NE(asText.err.find("4 of the numbers"), std::string::npos) << asText.err;
}

TEST(CliVerify, AChangedNumberOfAFiniteElementCaseFails) {
  const Runner cli;
  writeReference(cli, "fem.json", [](Json& reference) {
    Json& force = caseOf(reference, "b_cyl_push_nu0.30")["reaction_force"][2];
    force = 1.05 * force.get<double>();
  });
  const Outcome outcome =
      cli.run("verify --json --quick --engine splines --reference . --case b_cyl_push_nu0.30");
  EXPECT_EQ(outcome.exitCode, 4) << outcome.err;
  const Json report = outcome.json();
  EXPECT_EQ(report.at("failed"), 1);
  for (const Json& check : report.at("results").at(0).at("checks"))
    EXPECT_EQ(check.at("pass"), check.at("quantity") != "reaction") << check;
}

TEST(CliVerify, AnUnknownCaseIsRefusedWithTheNames) {
  const Runner cli;
  const Outcome outcome = cli.run("verify --case kelvin_exterior_bottle");
  EXPECT_EQ(outcome.exitCode, 3);
  for (const char* name :
       {"kelvin_exterior_bottle", "kelvin_exterior_torus", "a_cyl_side", "convergence_sphere"})
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  // Known, but not run, with the reason.
  const Outcome omitted = cli.run("verify --case hollow_sphere_internal_pressure_nu0.50");
  EXPECT_EQ(omitted.exitCode, 2);
  EXPECT_NE(omitted.err.find("cavity"), std::string::npos) << omitted.err;
  EXPECT_EQ(cli.run("verify --engine splines --case hollow_cylinder_plane_strain").exitCode, 2);
}

TEST(CliVerify, ReferencesThatAreNoneAreRefused) {
  const Runner cli;
  EXPECT_EQ(cli.run("verify --reference nowhere").exitCode, 3);
  writeReference(cli, "analytic.json", [](Json& reference) {
    caseOf(reference, "patch_linear_box_nu0.30")["u_expr"]["x"] = "3 * (x";
    caseOf(reference, "patch_linear_box_nu0.45").erase("material");
    caseOf(reference, "patch_linear_box_nu0.49")["points"] = Json::array();
  });
  for (const char* nu : {"0.30", "0.45", "0.49"}) {
    const Outcome outcome =
        cli.run(std::string("verify --reference . --case patch_linear_box_nu") + nu);
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  cli.write("fem.json", "{\"cases\": [");
  const Outcome broken = cli.run("verify --reference .");
  EXPECT_EQ(broken.exitCode, 3);
  EXPECT_NE(broken.err.find("fem.json"), std::string::npos) << broken.err;
}

TEST(CliVerify, WithoutADisplayThereIsATableButNoPlot) {
  const Runner cli;
  const Outcome outcome =
      cli.run("verify --quick --engine splines --case convergence_sphere --plot plot.png",
              "env -u DISPLAY");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_NE(outcome.out.find("order of u"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("no X display"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(cli.path("plot.png")));
  EXPECT_EQ(cli.run("verify --plot plot.jpg").exitCode, 2);
  EXPECT_EQ(cli.run("verify --case a_cyl_side --plot plot.png").exitCode, 2);
}

}  // namespace
}  // namespace palpa::cli_tests

// palpa-cli new, info, check, mesh.
#include <gtest/gtest.h>

#include <cstdlib>
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
    EXPECT_EQ(project.at("version"), 3);
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

TEST_F(CliProject, CheckNamesAllProblemsAtOnce) {
  cli_.run("new box --size 40,30,20 -o p.json");
  Json project = cli_.readJson("p.json");
  project["supports"] = Json::array();
  project["touches"] = Json::parse(R"([
    {"name": "a", "kind": "grab", "at_mm": [0, 0, 90], "displace_mm": [0, 0, -1]},
    {"name": "b", "kind": "grab", "at_mm": [0, 0, 20], "displace_mm": [0, 0, -1]},
    {"name": "c", "kind": "grab", "at_mm": [70, 0, 9], "displace_mm": [0, 0, -1]}])");
  cli_.writeJson("p.json", project);
  const Outcome outcome = cli_.run("check p.json --json");
  EXPECT_EQ(outcome.exitCode, 3);
  const Json problems = outcome.json().at("problems");
  ASSERT_EQ(problems.size(), 3U) << problems;
  EXPECT_NE(problems[0].get<std::string>().find("the touch \"a\""), std::string::npos);
  EXPECT_NE(problems[1].get<std::string>().find("the touch \"c\""), std::string::npos);
  EXPECT_NE(cli_.run("check p.json").out.find("error      the touch \"a\""), std::string::npos);
}

TEST_F(CliProject, PaintedSupportsGoAllTheWay) {
  cli_.run("new sphere --radius 25 --edge-length 6 -o p.json");
  Json project = cli_.readJson("p.json");
  project["supports"] = Json::parse(R"([{"name": "paint", "kind": "fixed", "where": [
    {"stroke": {"points_mm": [[-8, 0, -23], [0, 0, -25], [8, 0, -23]], "radius_mm": 7}},
    {"stroke": {"points_mm": [[0, -10, -22]], "radius_mm": 4}}]}])");
  project["loads"] = Json::parse(R"([{"name": "press", "kind": "pressure", "MPa": 0.001,
    "where": {"stroke": {"points_mm": [[25, 0, 0]], "radius_mm": 6}}}])");
  project["touches"] = Json::parse(
      R"([{"name": "poke", "kind": "grab", "at_mm": [0, 0, 25], "displace_mm": [0, 0, -2]}])");
  cli_.writeJson("p.json", project);
  EXPECT_EQ(cli_.runJson("check p.json").at("valid"), true);
  const std::string info = cli_.run("info p.json").out;
  EXPECT_NE(info.find("within 7 mm of (-8, 0, -23) and the stroke through 2 more points and within "
                      "4 mm of (0, -10, -22)"),
            std::string::npos)
      << info;
  // Beside the border of the support the quarters of quadratic triangles are uneven.
  EXPECT_GE(cli_.runJson("mesh p.json").at("quality").at("smallest_angle_degrees").get<double>(),
            7.0);
  const Json solved = cli_.runJson("solve p.json");
  const double pressed = 0.001 * std::numbers::pi * 36;  // a cap's projection is a bit less
  EXPECT_NEAR(solved.at("loads")[0].at("force_N")[0].get<double>(), -pressed, 0.1 * pressed);
  EXPECT_NEAR(solved.at("supports")[0].at("force_N")[0].get<double>(), pressed, 0.1 * pressed);
  const Json touched = cli_.runJson("touch p.json");
  EXPECT_LT(touched.at("contacts")[0].at("force_N")[2].get<double>(), 0.0);
  EXPECT_LE(touched.at("relative_balance").get<double>(), 0.02);

  // Painted beside the body: the command names the region and stops.
  project["supports"][0]["where"] =
      Json::parse(R"({"stroke": {"points_mm": [[0, 0, -60]], "radius_mm": 5}})");
  cli_.writeJson("p.json", project);
  const Outcome refused = cli_.run("mesh p.json");
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_NE(refused.err.find("paint"), std::string::npos) << refused.err;
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
  EXPECT_FALSE(outcome.err.empty());
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
  EXPECT_NE(text.out.find("error      the surface intersects itself near ("), std::string::npos);
}

TEST_F(CliProject, NewWithoutAFileWritesTheProjectToStandardOutput) {
  EXPECT_EQ(cli_.run("new box").json().at("format"), "palpa-project");
}

TEST_F(CliProject, MaterialsNamesTheSourceOfEachConstant) {
  const Json materials = cli_.runJson("materials").at("materials");
  EXPECT_GE(materials.size(), 10u);
  for (const Json& material : materials) {
    EXPECT_GT(material.at("youngs_modulus_MPa").get<double>(), 0.0);
    EXPECT_FALSE(material.at("reference").get<std::string>().empty());
  }
}

TEST_F(CliProject, NewTakesAMaterialFromTheLibrary) {
  const Json project = cli_.run("new box --material liver").json();
  EXPECT_EQ(project.at("material").at("name"), "Liver");
  EXPECT_EQ(cli_.run("new box --material cheese").exitCode, 3);
  EXPECT_EQ(cli_.run("new box --material liver --poisson-ratio 0.3").exitCode, 2);
}

TEST_F(CliProject, NewEstimatesTheModulusFromTheHardness) {
  // Gent's relation by hand: 0.0981 (56 + 7.62336 * 50) / (0.137505 (254 - 2.54 * 50)) = 2.4558
  // MPa.
  const Json material = cli_.run("new box --shore-a 50").json().at("material");
  EXPECT_EQ(material.at("youngs_modulus_MPa"), 2.456);
  EXPECT_EQ(material.at("poisson_ratio"), 0.48);
  EXPECT_FALSE(material.contains("density_kg_per_m3"));
  EXPECT_EQ(material.at("name"), "rubber of 50 Shore A, estimated");
  EXPECT_EQ(cli_.run("new box --shore-a 50 --poisson-ratio 0.49")
                .json()
                .at("material")
                .at("poisson_ratio"),
            0.49);
  const Json report = cli_.runJson("new box --shore-a 50 -o rubber.json");
  EXPECT_EQ(report.at("youngs_modulus_MPa"), 2.456);
  for (const char* wrong : {"19", "80.5", "A50", "50 --youngs-modulus 2", "50 --material liver"})
    EXPECT_EQ(cli_.run(std::string("new box --shore-a ") + wrong).exitCode, 2) << wrong;
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

TEST_F(CliProject, NewMakesEveryShape) {
  cli_.write("vase.json",
             R"({"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1],
                 "points_mm": [[15, 0], [25, 15], [5, 30], [12, 45]]})");
  cli_.write("square.json",
             R"({"degree": 1, "knots": [0, 0, 1, 2, 3, 4, 4],
                 "points_mm": [[0, 0], [30, 0], [30, 30], [0, 30], [0, 0]]})");
  cli_.write("tower.json", "[{\"z_mm\": 0, \"profile\": " + cli_.read("square.json") +
                               "}, {\"z_mm\": 20, \"profile\": " + cli_.read("square.json") + "}]");
  const double pi = std::numbers::pi;
  const std::vector<std::pair<std::string, double>> shapes{
      {"ellipsoid --radii 30,20,15", 4.0 / 3 * pi * 9000},
      {"cone --bottom-radius 20 --top-radius 10 --height 30", pi * 10 * 700},
      {"cone --bottom-radius 20 --top-radius 0 --height 30", pi * 10 * 400},
      {"capsule --radius 10 --length 30", pi * (3000 + 4000.0 / 3)},
      {"torus --major-radius 25 --minor-radius 8 --degree 4 --control-points 9",
       2 * pi * pi * 25 * 64},
      {"revolve --profile vase.json", 29779},
      {"extrude --profile square.json --height 20", 18000},
      {"loft --profile tower.json", 18000}};
  for (const auto& [arguments, volume] : shapes) {
    const Json report = cli_.runJson("new " + arguments + " -o p.json");
    EXPECT_LT(report.at("deviation_mm").get<double>(), 0.03) << arguments;
    const std::string kind = arguments.substr(0, arguments.find(' '));
    EXPECT_EQ(cli_.readJson("p.json").at("primitive").at("kind"), kind);
    EXPECT_NEAR(cli_.runJson("info p.json").at("volume_mm3").get<double>() / volume, 1.0, 2e-3)
        << arguments;
    // With a support, so that it can be touched at once.
    EXPECT_EQ(cli_.run("check p.json").exitCode, 0) << arguments;
  }
}

TEST_F(CliProject, NewSaysWhatIsWrongWithAProfile) {
  const std::vector<std::pair<std::string, std::string>> files{
      {R"({"degree": 3, "knots": [0, 0, 1, 1], "points_mm": [[0, 0], [1, "a"]]})",
       R"(points_mm[1][1]: found "a", expected a number)"},
      {R"({"degree": 9, "knots": [], "points_mm": []})", "degree: found 9, expected at most 5"},
      {R"({"degree": 3, "knots": []})", "points_mm: is missing"},
      {R"({"degree": 1, "knots": [], "points_mm": [], "weights": []})", "weights: unknown key"},
      {R"({"degree": 1, "knots": [0, 0, 1, 1], "points_mm": [[1, 2, 3], [1, 2]]})",
       "points_mm[0]: found a list of 3, expected 2 entries"},
      {R"({"degree": 1, "knots": [0, 0, 1, 2, 2], "points_mm": [[5, 0], [0, 10], [5, 20]]})",
       "the curve touches the axis near z = 10 mm"},
      {"[1, 2", "truncated"},
      {std::string(100000, '['), "nested deeper"}};
  for (const auto& [text, message] : files) {
    cli_.write("curve.json", text);
    const Outcome outcome = cli_.run("new revolve --profile curve.json -o p.json");
    EXPECT_EQ(outcome.exitCode, 3) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(cli_.path("p.json")));
  }
  EXPECT_EQ(cli_.run("new revolve --profile missing.json").exitCode, 3);
  EXPECT_EQ(cli_.run("new revolve --profile .").exitCode, 3);
  EXPECT_EQ(cli_.run("new torus --minor-radius 40").exitCode, 3);
  EXPECT_EQ(cli_.run("new sphere --degree 6").exitCode, 3);
  EXPECT_EQ(cli_.run("new sphere --control-points 3").exitCode, 3);
}

TEST_F(CliProject, NewRefusesWhatMakesNoSense) {
  for (const char* arguments :
       {"new pyramid", "new", "new sphere --radius -3", "new sphere --radius nan",
        "new sphere --radius 1e999", "new sphere --height 3", "new box --size 1,2",
        "new box --size 1,2,0", "new box --size 1,2,3,4", "new sphere --no-such-option",
        "new revolve", "new loft --height 3", "new cone --top-radius -1", "new torus --degree 2.5",
        "new box --profile p.json"}) {
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
    EXPECT_GT(report.at("quality").at("smallest_angle_degrees").get<double>(), 10);
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

TEST_F(CliProject, TheManualPageAndTheCompletionKnowEveryCommandAndOption) {
  const Outcome manual = cli_.run("--manual"), completion = cli_.run("--bash-completion");
  EXPECT_EQ(manual.exitCode, 0);
  EXPECT_EQ(completion.exitCode, 0);
  EXPECT_EQ(manual.out.find(".TH PALPA\\-CLI 1"), 0u);
  for (const char* word : {"solve", "touch", "convert", "friction", "accuracy"}) {
    EXPECT_NE(manual.out.find(word), std::string::npos) << word;
    EXPECT_NE(completion.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(cli_.run("--help").out.find("--manual"), std::string::npos);
  // Completions of two lines in a shell.
  cli_.write("completion", completion.out +
                               "COMP_WORDS=(palpa-cli touch --fr); COMP_CWORD=2; _palpa_cli\n"
                               "[[ ${COMPREPLY[*]} == --friction ]] || exit 1\n"
                               "COMP_WORDS=(palpa-cli so); COMP_CWORD=1; _palpa_cli\n"
                               "[[ ${COMPREPLY[*]} == solve ]]\n");
  EXPECT_EQ(std::system(("bash " + cli_.path("completion").string()).c_str()), 0);
}

TEST_F(CliProject, HelpHasAnExampleForEachCommand) {
  EXPECT_EQ(cli_.run("--help").exitCode, 0);
  EXPECT_EQ(cli_.run("--version").exitCode, 0);
  EXPECT_EQ(cli_.run("").exitCode, 2);
  EXPECT_EQ(cli_.run("frobnicate").exitCode, 2);
  for (const char* command : {"new", "info", "check", "mesh", "solve", "touch", "render", "import",
                              "export", "convert"}) {
    const Outcome help = cli_.run(std::string(command) + " --help");
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_NE(help.out.find(std::string("palpa-cli ") + command), std::string::npos) << help.out;
    EXPECT_NE(help.out.find("Example"), std::string::npos) << help.out;
  }
}

}  // namespace
}  // namespace palpa::cli_tests

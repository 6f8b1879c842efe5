// Choosing among the solids of a file: palpa-cli import --list, --solid, --all, --unit, --scale,
// --up.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

/// A block of 20 × 12 × 8 mm and a pin of radius 3 mm and height 20 mm at (30, 0, 0) mm.
std::string blockAndPin() {
  return PALPA_TEST_DATA "/cad/block_and_pin.step";
}

/// OBJ text of the cubes [x, x + 1] × [0, 1] × [0, 1], each a group.
std::string cubes(const std::vector<std::pair<std::string, double>>& groups) {
  std::string text;
  int first = 1;
  for (const auto& [name, x] : groups) {
    text += "o " + name + "\n";
    for (int i = 0; i < 8; ++i)
      text += "v " + std::to_string(x + (i & 1)) + " " + std::to_string((i >> 1) & 1) + " " +
              std::to_string(i >> 2) + "\n";
    for (const std::array<int, 4>& n : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      text += "f";
      for (const int corner : n) text += " " + std::to_string(first + corner);
      text += "\n";
    }
    first += 8;
  }
  return text;
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "no \"" << part << "\" in: " << text;
}

class CliSolids : public testing::Test {
 protected:
  Runner cli_;
};

TEST_F(CliSolids, AreListedWithNamesAndSizes) {
  const Json list = cli_.runJson("import " + blockAndPin() + " --list");
  EXPECT_EQ(list.at("unit_mm"), 1.0);
  ASSERT_EQ(list.at("solids").size(), 2U);
  const Json& block = list.at("solids")[0];
  EXPECT_EQ(block.at("number"), 1);
  EXPECT_EQ(block.at("name"), "block");
  EXPECT_EQ(block.at("faces"), 6);
  const std::array<double, 3> size{20, 12, 8};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(block.at("size_mm")[k].get<double>(), size[k], 1e-6);
  EXPECT_NEAR(block.at("volume_mm3").get<double>(), 1920.0, 1e-6);
  const Json& pin = list.at("solids")[1];
  EXPECT_EQ(pin.at("name"), "pin");
  EXPECT_NEAR(pin.at("low_mm")[0].get<double>(), 27.0, 1e-6);
  EXPECT_NEAR(pin.at("high_mm")[2].get<double>(), 20.0, 1e-6);

  const std::string text = cli_.run("import " + blockAndPin() + " --list").out;
  EXPECT_TRUE(has(text, "2 solids"));
  EXPECT_TRUE(has(text, "unit       mm\n"));
  EXPECT_TRUE(has(text, "  1  block  20 × 12 × 8 mm, 6 faces, 1920 mm³\n"));
  EXPECT_TRUE(has(text, "  2  pin    6 × 6 × 20 mm, 3 faces, "));

  cli_.write("cubes.obj", cubes({{"pot", 0}, {"lid", 3}}));
  const std::string mesh = cli_.run("import cubes.obj --list --unit m --scale 10").out;
  EXPECT_TRUE(has(mesh, "unit       not stated, read as m\n"));
  EXPECT_TRUE(has(mesh, "  2  lid  10,000 × 10,000 × 10,000 mm, 12 triangles, "));
  EXPECT_TRUE(has(mesh, "note       \"lid\": The body is 10,000 mm in size: check the unit"));
  EXPECT_TRUE(cli_.runJson("import cubes.obj --list").at("unit_mm").is_null());
}

TEST_F(CliSolids, SeveralWithoutAChoiceAreAnErrorThatSaysWhatToDo) {
  for (const std::string& command :
       {"import " + blockAndPin(), "touch " + blockAndPin() + " --place auto --depth 1%",
        "convert " + blockAndPin() + " -o b.stl"}) {
    const Outcome outcome = cli_.run(command);
    EXPECT_EQ(outcome.exitCode, 3) << command;
    EXPECT_TRUE(has(outcome.err,
                    "contains 2 solids, but a project has one body; choose one: 1 \"block\" of 20 "
                    "× 12 × 8 mm; 2 \"pin\" of 6 × 6 × 20 mm; give --solid N, or import them all "
                    "with 'palpa-cli import FILE --all -o FOLDER'"));
  }
}

TEST_F(CliSolids, AreChosenByNumberOrName) {
  const Json block = cli_.runJson("import " + blockAndPin() + " --solid 1 -o block.json");
  EXPECT_EQ(block.at("kind"), "solid");
  EXPECT_EQ(block.at("name"), "block");
  EXPECT_NEAR(block.at("volume_mm3").get<double>(), 1920.0, 1e-6);
  EXPECT_EQ(block.at("notes")[0], "Read solid 1 of 2, \"block\".");
  const Json pin = cli_.runJson("import " + blockAndPin() + " --solid pin -o pin.json");
  EXPECT_EQ(pin.at("kind"), "mesh body");
  EXPECT_EQ(pin.at("name"), "pin");
  EXPECT_TRUE(cli_.runJson("check pin.json").at("valid"));
  const Json info = cli_.runJson("info " + blockAndPin() + " --solid block");
  EXPECT_NEAR(info.at("volume_mm3").get<double>(), 1920.0, 1e-6);
  const Json touched =
      cli_.runJson("touch " + blockAndPin() + " --solid block --place auto --depth 1%");
  EXPECT_GT(norm(touched.at("contacts")[0].at("force_N")), 0.0);

  const Outcome wrong = cli_.run("import " + blockAndPin() + " --solid lid");
  EXPECT_EQ(wrong.exitCode, 3);
  EXPECT_TRUE(has(wrong.err, "has no solid \"lid\"; its solids are 1 \"block\" of"));
}

TEST_F(CliSolids, AllBecomeProjects) {
  const Json all = cli_.runJson("import " + blockAndPin() + " --all -o parts");
  ASSERT_EQ(all.at("solids").size(), 2U);
  EXPECT_EQ(all.at("solids")[1].at("project"), "parts/pin.json");
  EXPECT_EQ(cli_.readJson("parts/block.json").at("name"), "block");
  EXPECT_TRUE(cli_.runJson("check parts/pin.json").at("valid"));

  cli_.run("import " + blockAndPin() + " --all -o 'by/{number}_{name}.palpa' --scale 2");
  EXPECT_NEAR(cli_.runJson("info by/1_block.palpa").at("volume_mm3").get<double>(), 8 * 1920.0,
              1e-6);
  // Names that are no file names, and equal after cleaning.
  cli_.write("cubes.obj", cubes({{"a/b", 0}, {"a:b", 3}, {"..", 6}}));
  const Json odd = cli_.runJson("import cubes.obj --all -o odd");
  EXPECT_EQ(odd.at("solids")[0].at("project"), "odd/a_b.json");
  EXPECT_EQ(odd.at("solids")[1].at("project"), "odd/a_b_2.json");
  EXPECT_EQ(odd.at("solids")[2].at("project"), "odd/_...json");
}

TEST_F(CliSolids, OneThatFailsDoesNotStopTheOthers) {
  cli_.write("cubes.obj", cubes({{"pot", 0}, {"lid", 3}}));
  std::filesystem::create_directories(cli_.path("parts/pot.json"));  // a folder is in the way
  const Outcome outcome = cli_.run("import cubes.obj --all -o parts");
  EXPECT_EQ(outcome.exitCode, 3);
  EXPECT_TRUE(has(outcome.out, "1 of 2 solids written"));
  EXPECT_TRUE(has(outcome.out, "  1  not written: "));
  EXPECT_TRUE(has(outcome.out, "  2  parts/lid.json"));
  EXPECT_TRUE(has(outcome.err, "1 of 2 solids could not be imported"));
  EXPECT_EQ(cli_.readJson("parts/lid.json").at("name"), "lid");
}

TEST_F(CliSolids, UnitScaleAndUpDirectionAreApplied) {
  cli_.write("cube.obj", cubes({{"cube", 2}}));
  const auto box = [&](const std::string& options) {
    return cli_.runJson("import cube.obj --list " + options).at("solids")[0];
  };
  EXPECT_EQ(box("--unit in").at("low_mm")[0], 50.8);
  EXPECT_EQ(box("--scale 0.5").at("high_mm")[0], 1.5);
  EXPECT_EQ(box("--up -x").at("low_mm")[2], -3.0);
  EXPECT_EQ(box("--up +x").at("low_mm")[2], 2.0);
  const Json report = cli_.runJson("import cube.obj --unit cm --up y -o cube.json");
  EXPECT_NEAR(report.at("volume_mm3").get<double>(), 1000.0, 1e-9);
  EXPECT_NEAR(cli_.runJson("info cube.obj --unit cm").at("volume_mm3").get<double>(), 1000.0, 1e-9);
  EXPECT_NEAR(cli_.runJson("convert cube.obj --scale 3 -o c.stl").at("volume_mm3").get<double>(),
              27.0, 1e-9);
  // The pipe's file is in inches; its numbers are now taken as mm.
  const std::string pipe = PALPA_TEST_DATA "/cad/quarter_pipe_inch.step";
  EXPECT_EQ(cli_.runJson("import " + pipe + " --list").at("unit_mm"), 25.4);
  EXPECT_NEAR(cli_.runJson("info " + pipe + " --unit mm").at("volume_mm3").get<double>(),
              3063.05 / std::pow(25.4, 3), 1e-3);
}

TEST_F(CliSolids, MistakesAreUsageErrors) {
  cli_.run("new box -o b.json");
  cli_.write("cubes.obj", cubes({{"pot", 0}, {"lid", 3}}));
  const auto expectUsage = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = cli_.run(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_TRUE(has(outcome.err, words)) << arguments;
  };
  expectUsage("import cubes.obj --solid 1 --unit parsec",
              "--unit: expected mm, cm, m, km, um, mil, in or ft, found 'parsec'");
  expectUsage("import cubes.obj --solid 1 --up w", "--up: expected x, -x, y, -y, z or -z, found");
  expectUsage("import cubes.obj --solid 1 --scale 0", "--scale: expected a number greater than");
  expectUsage("import cubes.obj --list --all", "--list writes nothing");
  expectUsage("import cubes.obj --list --solid 1", "--list writes nothing");
  expectUsage("import cubes.obj --all", "--all needs -o with a folder");
  expectUsage("import cubes.obj --all --solid 1 -o parts", "--all takes every solid by its name");
  expectUsage("import cubes.obj --all -o parts.json", "is one file for all solids");
  const Outcome wrongEnding = cli_.run("import cubes.obj --all -o '{name}.step'");
  EXPECT_EQ(wrongEnding.exitCode, 3);
  EXPECT_TRUE(has(wrongEnding.err, "{name}.step")) << wrongEnding.err;
  EXPECT_TRUE(has(wrongEnding.err, ".json")) << wrongEnding.err;
  expectUsage("info b.json --solid 1", "b.json is a project, which has one body in mm");
  expectUsage("convert b.json --scale 2 -o b.stl", "b.json is a project, which has one body in mm");
}

}  // namespace
}  // namespace palpa::cli_tests

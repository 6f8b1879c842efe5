#include <gtest/gtest.h>

#include <chrono>

#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

std::string goodText() {
  Project project;
  project.name = "box";
  project.material = {"rubber", 1.5, 0.45};
  project.body = makeBox({40, 30, 20});
  project.supports = {{"base", Support::Kind::fixed, Region::ofPatches({"bottom"}), {0, 0, 0}}};
  project.loads = {{"press", Pressure{Region::ofPatches({"top"}), 0.25}}};
  project.touches = {{"poke", {0, 0, 20}, TouchDisplacement{{0, 0, -2}}, 3.0}};
  project.mesh.edgeLength = 4.0;
  return toJson(project);
}

std::string errorOf(const std::string& text) {
  try {
    parseProject(text, "box.json");
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "no error";
}

/// The error of the good text with the first `from` replaced by `to`.
std::string errorWith(const std::string& from, const std::string& to) {
  std::string text = goodText();
  const std::size_t at = text.find(from);
  if (at == std::string::npos) return "the text has no " + from;
  return errorOf(text.replace(at, from.size(), to));
}

TEST(ProjectErrors, NamePathFoundAndExpected) {
  EXPECT_EQ(errorWith("\"kind\": \"fixed\"", "\"kind\": \"glued\""),
            "box.json: supports[0].kind: found \"glued\", expected one of \"fixed\", \"roller\"");
  EXPECT_EQ(errorWith("\"kind\": \"pressure\"", "\"kind\": \"push\""),
            "box.json: loads[0].kind: found \"push\", expected one of \"pressure\", \"traction\", "
            "\"bump\"");
  EXPECT_EQ(errorWith("\"MPa\": 0.25", "\"MPa\": [1, 2, 3]"),
            "box.json: loads[0].MPa: found a list of 3, expected a number");
  EXPECT_EQ(errorWith("\"edge_length_mm\": 4", "\"edge_length_mm\": 0"),
            "box.json: mesh.edge_length_mm: found 0, expected more than 0");
  EXPECT_EQ(errorWith("\"poisson_ratio\": 0.45", "\"poisson_ratio\": 0.51"),
            "box.json: material.poisson_ratio: found 0.51, expected at most 0.5");
  EXPECT_EQ(errorWith("\"youngs_modulus_MPa\": 1.5", "\"youngs_modulus_MPa\": \"soft\""),
            "box.json: material.youngs_modulus_MPa: found \"soft\", expected a number");
  EXPECT_EQ(errorWith("\"at_mm\": [0, 0, 20]", "\"at_mm\": [0, 0]"),
            "box.json: touches[0].at_mm: found a list of 2, expected 3 entries");
}

TEST(ProjectErrors, RefuseUnknownMissingAndRepeatedKeys) {
  EXPECT_EQ(errorWith("\"poisson_ratio\"", "\"poisons_ratio\""),
            "box.json: material.poisons_ratio: unknown key, expected one of \"name\", "
            "\"poisson_ratio\", \"youngs_modulus_MPa\"");
  EXPECT_EQ(errorWith(", \"poisson_ratio\": 0.45", ""),
            "box.json: material.poisson_ratio: is missing");
  EXPECT_EQ(errorWith("\"poisson_ratio\": 0.45", "\"poisson_ratio\": 0.4, \"poisson_ratio\": 0.45"),
            "box.json: material.poisson_ratio: this key occurs twice");
  EXPECT_EQ(errorWith("\"displace_mm\": [0, 0, -2], ", ""),
            "box.json: touches[0]: expected either displace_mm or force_N, found neither");
  EXPECT_EQ(errorWith("{\"patches\": [\"bottom\"]}", "{}"),
            "box.json: supports[0].where: found no key, expected exactly one of \"half_space\", "
            "\"patches\"");
}

TEST(ProjectErrors, CheckWhatTheSchemaCannot) {
  EXPECT_EQ(errorWith("[\"bottom\"]", "[\"botom\"]"),
            "box.json: supports[0].where.patches[0]: no patch is named \"botom\"; the body has "
            "\"side_xmin\", \"side_xmax\", \"side_ymin\", \"side_ymax\", \"bottom\", \"top\"");
  EXPECT_EQ(errorWith("[0, 0, 0, 0, 1, 1, 1, 1]", "[0, 0, 0, 0, -1, 1, 1, 1]"),
            "box.json: solid.patches[0].knots[0][4]: -1 is smaller than the knot before it (0)");
}

TEST(ProjectErrors, ReadFormatAndVersionFirst) {
  EXPECT_EQ(errorWith("\"version\": 2", "\"version\": 3"),
            "box.json: version: found 3; this program reads up to version 2; a newer Palpa is "
            "needed");
  EXPECT_EQ(errorOf("{}").find("box.json: format: is missing"), 0U);
  EXPECT_NE(errorOf("{\"format\": \"other\"}").find("found \"other\", expected \"palpa-project\""),
            std::string::npos)
      << errorOf("{\"format\": \"other\"}");
  EXPECT_EQ(errorOf("[1]").find("box.json: this is no Palpa project"), 0U);
}

TEST(ProjectErrors, PointIntoBrokenText) {
  EXPECT_EQ(errorWith("\"version\": 2,", "\"version\": 2;").find("box.json: line 3, column 15"), 0U)
      << errorWith("\"version\": 2,", "\"version\": 2;");
  const std::string text = goodText();
  for (std::size_t length : {std::size_t{0}, std::size_t{1}, text.size() / 2, text.size() - 3}) {
    const std::string error = errorOf(text.substr(0, length));
    EXPECT_NE(error.find("line "), std::string::npos) << error;
  }
  EXPECT_NE(errorOf(text.substr(0, text.size() / 2)).find("truncated"), std::string::npos);
  EXPECT_EQ(errorWith("\"MPa\": 0.25", "\"MPa\": 1e999"),
            "box.json: loads[0].MPa: the number is too large");
  EXPECT_NE(errorWith("\"MPa\": 0.25", "\"MPa\": NaN").find("not valid JSON"), std::string::npos);
  EXPECT_NE(errorWith("rubber", "rub\xff").find("not valid JSON"), std::string::npos);
}

TEST(ProjectErrors, HostileTextEndsWithinASecond) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(errorOf(std::string(10'000'000, '[')).find("nested deeper"), std::string::npos);
  std::string many = "{\"format\": \"palpa-project\", \"version\": 1, \"x\": [";
  for (int i = 0; i < 2'500'000; ++i) many += "0,";
  EXPECT_NE(errorOf(many + "0]}").find("more than 2000000 values"), std::string::npos);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 5.0);  // generous for sanitizers and busy machines
}

TEST(ProjectErrors, AnyOneCharacterChangedNeverCrashes) {
  const std::string text = goodText();
  for (std::size_t i = 0; i < text.size(); i += 23)
    for (char c : {'\0', '"', '}', '9', '-', '\\'}) {
      std::string changed = text;
      changed[i] = c;
      errorOf(changed);  // an error or a project, but nothing else may come out
    }
}

}  // namespace
}  // namespace palpa::modeling

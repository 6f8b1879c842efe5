#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"

namespace palpa::modeling {
namespace {

std::string goodText() {
  Project project;
  project.name = "box";
  project.material = {"rubber", 1.5, 0.45};
  project.body = makeBox({40, 30, 20});
  project.supports = {{"base", Support::Kind::kFixed, Region::ofPatches({"bottom"}), {0, 0, 0}}};
  project.loads = {{"press", Pressure{Region::ofPatches({"top"}), 0.25}}};
  project.touches = {{"poke", {0, 0, 20}, TouchKind::kGrab, {0, 0, -2}, 3.0}};
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

/// Error of the valid text with the first `from` replaced by `to`.
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
            "\"bump\", \"force\", \"moment\", \"gravity\"");
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

/// Error of the valid text with its touch replaced by this object.
std::string errorOfTouch(const std::string& touch) {
  std::string text = goodText();
  const std::string key = "\"touches\": [\n    ";
  const std::size_t begin = text.find(key) + key.size();
  return errorOf(text.replace(begin, text.find('\n', begin) - begin, touch));
}

/// Kinds of touch as listed in the schema.
std::string kindNames() {
  std::string names;
  for (const TouchKindInfo& info : kTouchKinds)
    names += (names.empty() ? "\"" : ", \"") + std::string(info.name) + "\"";
  return names;
}

TEST(ProjectErrors, TheSchemaHasTheKeysOfEveryKindOfTouch) {
  for (const TouchKindInfo& info : kTouchKinds) {
    const std::string head =
        R"({"name": "t", "at_mm": [0, 0, 20], "kind": ")" + std::string(info.name) + "\"";
    const std::string vector = ", \"" + std::string(info.vectorKey()) + "\": [0, 0, -1]";
    EXPECT_EQ(errorOfTouch(head + vector + "}"), "no error") << info.name;
    EXPECT_EQ(errorOfTouch(head + "}") == "no error", !info.needsVector) << info.name;
    EXPECT_EQ(errorOfTouch(head + vector + R"(, "friction": 0.5})") == "no error", info.presses)
        << info.name;
  }
}

/// Error of the valid text with its load replaced by this object.
std::string errorOfLoad(const std::string& load) {
  std::string text = goodText();
  const std::string key = "\"loads\": [\n    ";
  const std::size_t begin = text.find(key) + key.size();
  return errorOf(text.replace(begin, text.find('\n', begin) - begin, load));
}

TEST(ProjectErrors, LoadsByTheirSumHaveTheirKeys) {
  const std::string top = R"("name": "l", "where": {"patches": ["top"]}, )";
  EXPECT_EQ(errorOfLoad("{" + top + R"("kind": "force", "force_N": [1, 2, 3]})"), "no error");
  EXPECT_EQ(errorOfLoad("{" + top + R"("kind": "moment", "moment_N_mm": [1, 2, 3]})"), "no error");
  EXPECT_EQ(errorOfLoad(R"({"name": "l", "kind": "gravity"})"), "no error");
  EXPECT_EQ(errorOfLoad(R"({"name": "l", "kind": "gravity", "acceleration_m_per_s2": [0, 0, 1]})"),
            "no error");
  EXPECT_EQ(errorOfLoad("{" + top + R"("kind": "moment"})"),
            "box.json: loads[0].moment_N_mm: is missing");
  EXPECT_EQ(errorOfLoad(R"({"name": "l", "kind": "force", "force_N": [1, 2, 3]})"),
            "box.json: loads[0].where: is missing");
  EXPECT_EQ(errorOfLoad("{" + top + R"("kind": "gravity"})"),
            "box.json: loads[0].where: unknown key, expected one of \"acceleration_m_per_s2\", "
            "\"kind\", \"name\"");
  EXPECT_EQ(
      errorOfLoad(R"({"name": "l", "kind": "weight"})"),
      "box.json: loads[0].kind: found \"weight\", expected one of \"pressure\", \"traction\", "
      "\"bump\", \"force\", \"moment\", \"gravity\"");
  EXPECT_EQ(errorOfLoad("{" + top.substr(0, 13) + R"("where": {"patches": ["lid"]}, )" +
                        R"("kind": "force", "force_N": [1, 2, 3]})")
                .substr(0, 56),
            "box.json: loads[0].where.patches[0]: no patch is named \"");
}

TEST(ProjectErrors, EveryKindOfTouchHasItsKeys) {
  const std::string at = R"("name": "t", "at_mm": [0, 0, 20])";
  const std::string by = R"("displace_mm": [0, 0, -1])";
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "push", )" + by + R"(, "friction": 10})"),
            "no error");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "pin"})"), "no error");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "squeeze"})"),
            "box.json: touches[0].kind: found \"squeeze\", expected one of " + kindNames());
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "ball", )" + by + R"(, "friction": -0.1})"),
            "box.json: touches[0].friction: found -0.1, expected at least 0");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "push", )" + by + R"(, "friction": 10.5})"),
            "box.json: touches[0].friction: found 10.5, expected at most 10");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "ball"})"),
            "box.json: touches[0].displace_mm: is missing");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "force", )" + by + "}"),
            "box.json: touches[0].displace_mm: unknown key, expected one of \"at_mm\", "
            "\"force_N\", \"kind\", \"name\", \"radius_mm\"");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "pin", "friction": 0.1})"),
            "box.json: touches[0].friction: unknown key, expected one of \"at_mm\", "
            "\"displace_mm\", \"kind\", \"name\", \"radius_mm\"");
  EXPECT_EQ(errorOfTouch("{" + at + R"(, "kind": "ball", )" + by + R"(, "radius_mm": 0})"),
            "box.json: touches[0].radius_mm: found 0, expected more than 0");
}

TEST(ProjectErrors, NumbersOfTouchesAreCheckedBeforeTheyAreSaved) {
  Project project = parseProject(goodText(), "box.json");
  const auto errorOf = [&](TouchKind kind, const Eigen::Vector3d& vector,
                           double friction = 0) -> std::string {
    Touch& touch = project.touches[0];
    touch.kind = kind;
    touch.vector = vector;
    touch.friction = friction;
    try {
      checkProject(project);
    } catch (const ModelingError& error) {
      return error.what();
    }
    return "no error";
  };
  const double nan = std::nan("");
  EXPECT_EQ(errorOf(TouchKind::kPush, {0, 0, -1}, 0.5), "no error");
  EXPECT_EQ(errorOf(TouchKind::kPush, {0, 0, -1}, nan),
            "touches[0].friction: nan is outside the range 0 … 10");
  EXPECT_EQ(errorOf(TouchKind::kBall, {0, 0, -1}, -1.0),
            "touches[0].friction: -1 is outside the range 0 … 10");
  EXPECT_EQ(errorOf(TouchKind::kBall, {0, nan, -1}), "touches[0].displace_mm[1]: must be finite");
  EXPECT_EQ(errorOf(TouchKind::kPin, {0, nan, -1}), "touches[0].displace_mm[1]: must be finite");
  EXPECT_EQ(errorOf(TouchKind::kForce, {0, nan, -1}), "touches[0].force_N[1]: must be finite");
}

TEST(ProjectErrors, RefuseUnknownMissingAndRepeatedKeys) {
  EXPECT_EQ(errorWith("\"poisson_ratio\"", "\"poisons_ratio\""),
            "box.json: material.poisons_ratio: unknown key, expected one of \"density_kg_per_m3\", "
            "\"name\", "
            "\"poisson_ratio\", \"youngs_modulus_MPa\"");
  EXPECT_EQ(errorWith(", \"poisson_ratio\": 0.45", ""),
            "box.json: material.poisson_ratio: is missing");
  EXPECT_EQ(errorWith("\"poisson_ratio\": 0.45", "\"poisson_ratio\": 0.4, \"poisson_ratio\": 0.45"),
            "box.json: material.poisson_ratio: this key occurs twice");
  EXPECT_EQ(errorWith("\"displace_mm\": [0, 0, -2], ", ""),
            "box.json: touches[0]: expected either displace_mm or force_N, found neither");
  EXPECT_EQ(errorWith("{\"patches\": [\"bottom\"]}", "{}"),
            "box.json: supports[0].where: found no key, expected exactly one of \"half_space\", "
            "\"patches\", \"stroke\"");
  EXPECT_EQ(errorWith("{\"patches\": [\"bottom\"]}",
                      "{\"stroke\": {\"points_mm\": [[0, 0]], \"radius_mm\": 2}}"),
            "box.json: supports[0].where.stroke.points_mm[0]: found a list of 2, expected 3 "
            "entries");
}

TEST(ProjectErrors, CheckConditionsBeyondTheSchema) {
  EXPECT_EQ(errorWith("[\"bottom\"]", "[\"botom\"]"),
            "box.json: supports[0].where.patches[0]: no patch is named \"botom\"; the body has "
            "\"side_xmin\", \"side_xmax\", \"side_ymin\", \"side_ymax\", \"bottom\", \"top\"");
  EXPECT_EQ(errorWith("[0, 0, 0, 0, 1, 1, 1, 1]", "[0, 0, 0, 0, -1, 1, 1, 1]"),
            "box.json: solid.patches[0].knots[0][4]: -1 is smaller than the knot before it (0)");
}

TEST(ProjectErrors, ReadFormatAndVersionFirst) {
  EXPECT_EQ(errorWith("\"version\": 3", "\"version\": 4"),
            "box.json: version: found 4; this program reads up to version 3; a newer Palpa is "
            "needed");
  EXPECT_EQ(errorOf("{}").find("box.json: format: is missing"), 0U);
  EXPECT_NE(errorOf("{\"format\": \"other\"}").find("found \"other\", expected \"palpa-project\""),
            std::string::npos)
      << errorOf("{\"format\": \"other\"}");
  EXPECT_EQ(errorOf("[1]").find("box.json: this is not a Palpa project"), 0U);
}

TEST(ProjectErrors, PointIntoBrokenText) {
  EXPECT_EQ(errorWith("\"version\": 3,", "\"version\": 3;").find("box.json: line 3, column 15"), 0U)
      << errorWith("\"version\": 3,", "\"version\": 3;");
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

TEST(ProjectErrors, CheckHowSplineElementsAreChosen) {
  const auto error = [](const std::string& more) {
    return errorWith("\"edge_length_mm\": 4", "\"edge_length_mm\": 4, " + more);
  };
  EXPECT_EQ(error(R"("engine": "splines", "accuracy": 1e-4, "element_length_mm": 3)"), "no error");
  EXPECT_EQ(error(R"("engine": "cubes")"),
            "box.json: mesh.engine: found \"cubes\", expected one of \"automatic\", \"splines\", "
            "\"triangles\", \"quadratic\"");
  EXPECT_EQ(error(R"("accuracy": 0.2)"),
            "box.json: mesh.accuracy: found 0.2, expected at most 0.1");
  EXPECT_EQ(error(R"("spline_density": 0.5)"),
            "box.json: mesh.spline_density: found 0.5, expected at least 1");
  EXPECT_EQ(error(R"("element_length_mm": 0)"),
            "box.json: mesh.element_length_mm: found 0, expected more than 0");
  // Conditions of the schema, for settings from other sources.
  MeshSettings settings;
  settings.accuracy = 0.2;
  EXPECT_THROW(settings.validate(), ModelingError);
  settings = {};
  settings.splineDensity = 17;
  EXPECT_THROW(settings.validate(), ModelingError);
  settings = {};
  settings.elementLength = -1.0;
  EXPECT_THROW(settings.validate(), ModelingError);
  const auto message = [](const MeshSettings& wrong) -> std::string {
    try {
      wrong.validate();
    } catch (const ModelingError& refused) {
      return refused.what();
    }
    return "no error";
  };
  settings = {};
  settings.refinementLevels = -1;
  EXPECT_EQ(message(settings).rfind("mesh.refinement.levels: -1 is outside 0 … ", 0), 0U);
  settings = {};
  settings.featureFraction = 1.5;
  EXPECT_EQ(message(settings), "mesh.feature_fraction: 1.5 is outside 0 … 1");
}

TEST(ProjectErrors, CheckMeshBodiesAndEdges) {
  EXPECT_EQ(errorWith("\"patches\": [\n      {",
                      "\"smooth_edges\": [{\"patch\": \"lid\", \"side\": "
                      "\"u_max\"}], \"patches\": [\n      {"),
            "box.json: solid.smooth_edges[0].patch: no patch is named \"lid\"");
  EXPECT_EQ(errorWith("\"patches\": [\n      {",
                      "\"smooth_edges\": [{\"patch\": \"top\", \"side\": "
                      "\"left\"}], \"patches\": [\n      {"),
            "box.json: solid.smooth_edges[0].side: found \"left\", expected one of \"u_min\", "
            "\"u_max\", \"v_min\", \"v_max\"");
  EXPECT_EQ(
      errorWith("\"edge_length_mm\": 4", "\"edge_length_mm\": 4, \"patch_factors\": {\"lid\": 2}")
          .find("box.json: mesh.patch_factors.lid: no patch has this name; the body has"),
      0U);
  EXPECT_EQ(
      errorWith("\"edge_length_mm\": 4", "\"edge_length_mm\": 4, \"patch_factors\": {\"top\": 0}"),
      "box.json: mesh.patch_factors.top: found 0, expected at least 0.05");
  EXPECT_EQ(errorWith("\"solid\"", "\"mesh_body\": {}, \"solid\""),
            "box.json: mesh_body.vertices_mm: is missing");
  EXPECT_EQ(
      errorWith("\"supports\"", "\"primitive\": {\"kind\": \"cube\"}, \"supports\""),
      "box.json: primitive.kind: found \"cube\", expected one of \"box\", \"sphere\", "
      "\"ellipsoid\", \"cylinder\", \"cone\", \"capsule\", \"torus\", \"revolve\", \"extrude\", "
      "\"loft\"");

  const auto meshError = [](const std::string& triangles, const std::string& faces,
                            const std::string& more = "", const std::string& engine = "") {
    return errorOf(
        R"({"format": "palpa-project", "version": 3, "mesh": {"edge_length_mm": 1)" + engine +
        R"(}, "material": )"
        R"({"youngs_modulus_MPa": 1, "poisson_ratio": 0}, "mesh_body": {"vertices_mm": [[0, 0, 0], )"
        R"([1, 0, 0], [0, 1, 0], [0, 0, 1]], "triangles": [[0, 2, 1], [3, 0, 1], [2, 3, 1], )" +
        triangles + "], \"faces\": [" + faces + "]}" + more + "}");
  };
  const std::string all = R"({"name": "a", "triangles": [[0, 4]]})";
  EXPECT_EQ(meshError("[0, 3, 2]", all), "no error");
  EXPECT_EQ(meshError("[0, 3, 2]", R"({"name": "a", "triangles": [[0, 3], [3, 2]]})"),
            "box.json: mesh_body.faces[0].triangles[1]: ends after the last of the 4 triangles");
  EXPECT_EQ(meshError("[0, 3, 2]", all + R"(, {"name": "b", "triangles": [[1, 1]]})"),
            "box.json: mesh_body.faces[1].triangles[0]: the triangle 1 already has a face");
  EXPECT_EQ(meshError("[0, 3, 2]", R"({"name": "a", "triangles": [[0, 3]]})"),
            "box.json: mesh_body.faces: no face has the triangle 3");
  EXPECT_EQ(meshError("[0, 3, 2]", R"({"name": "a", "triangles": [[2147483647, 2147483647]]})"),
            "box.json: mesh_body.faces[0].triangles[0]: ends after the last of the 4 triangles");
  EXPECT_EQ(meshError("[0, 3, 9]", all),
            "box.json: mesh_body.triangles[3]: an index is out of range; there are 4 vertices");
  EXPECT_EQ(meshError("[0, 3, 2]", all, R"(, "primitive": {"kind": "sphere", "radius_mm": 1})"),
            "box.json: primitive: a mesh body is not made from a primitive");
  EXPECT_EQ(meshError("[0, 3, 2]", all, "", R"(, "engine": "triangles")"), "no error");
  EXPECT_EQ(meshError("[0, 3, 2]", all, "", R"(, "engine": "splines")"),
            "box.json: mesh.engine: a mesh body has no spline patches; select automatic, triangles "
            "or quadratic");
  EXPECT_EQ(meshError("[0, 3, 2]", all, R"(, "solid": {"control_points_mm": [], "patches": []})")
                .find("box.json: solid.control_points_mm: "),
            0U);
}

TEST(ProjectErrors, ExactlyOneBodyIsNeeded) {
  const std::string head =
      R"({"format": "palpa-project", "version": 3, "mesh": {"edge_length_mm": 1}, "material": )"
      R"({"youngs_modulus_MPa": 1, "poisson_ratio": 0})";
  EXPECT_EQ(errorOf(head + "}"),
            "box.json: the file: expected either solid or mesh_body, found neither");
  const std::string good = goodText();
  const std::size_t solid = good.find("\"solid\"");
  EXPECT_EQ(errorOf(std::string(good).insert(
                solid, R"("mesh_body": {"vertices_mm": [[0, 0, 0], [1, 0, 0], [0, 1, 0], )"
                       R"([0, 0, 1]], "triangles": [[0, 2, 1], [3, 0, 1], [2, 3, 1], [0, 3, 2]], )"
                       R"("faces": [{"name": "a", "triangles": [[0, 4]]}]}, )")),
            "box.json: the file: expected either solid or mesh_body, found both");
}

/// Text that repeats `item`; the whole stays below the limits on size or exceeds them.
std::string repeated(const std::string& begin, const std::string& item, int count,
                     const std::string& end) {
  std::string text = "{\"format\": \"palpa-project\", \"version\": 3, " + begin;
  for (int i = 0; i < count; ++i) text += (i > 0 ? "," : "") + item;
  return text + end + "}";
}

TEST(ProjectErrors, HostileTextIsRefused) {
  EXPECT_NE(errorOf(std::string(10'000'000, '[')).find("nested deeper"), std::string::npos);
  EXPECT_NE(errorOf(repeated("\"x\": [", "0", 2'500'000, "]")).find("more than 2000000 values"),
            std::string::npos);
  EXPECT_EQ(errorOf(repeated("\"name\": \"", "long", 1'000'000, "\"")),
            "box.json: name: a text of 4999999 bytes; at most 100000 are accepted");
  EXPECT_EQ(
      errorOf(repeated("\"", "long", 1'000'000, "\": 1")),
      "box.json: long,long,long,long,long,long,long,long,long,long,long,long,: a text of 4999999 "
      "bytes; at most 100000 are accepted");
  std::string keys = "\"view\": {\"k\": 0";
  for (int i = 0; i < 20'000; ++i) keys += ", \"" + std::to_string(i) + "\": 0";
  EXPECT_EQ(errorOf(repeated(keys, "", 0, "}")),
            "box.json: view.9999: more than 10000 keys in one object");
  EXPECT_NE(errorOf(repeated("\"solid\": [", "[0]", 900'000, "]")).find("is missing"),
            std::string::npos);
  const std::string longName(50'000, 'n');
  const std::string clipped = errorWith("[\"bottom\"]", "[\"" + longName + "\"]");
  EXPECT_LT(clipped.size(), 2100U);
  EXPECT_EQ(clipped.find("box.json: supports[0].where.patches[0]: no patch is named \"nnn"), 0U);
}

/// Peak memory of this process so far, MB. Not with sanitizers, which keep freed memory.
long peakMegabytes() {
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

TEST(ProjectErrors, HostileTextCostsLittleMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need additional memory";
#endif
  const auto child = testing_support::startChild([] {
    const std::string text = repeated("\"solid\": [", "[0]", 990'000, "]");  // 4 MB, 2 M values
    const long before = peakMegabytes();
    errorOf(text);
    const long after = peakMegabytes();
    ::_exit(after - before < 250 ? 0 : 1);
  });
  EXPECT_EQ(testing_support::resultOf(child), 0);
}

TEST(ProjectErrors, ChangingAnyCharacterNeverCrashes) {
  const std::string text = goodText();
  for (std::size_t i = 0; i < text.size(); i += 23)
    for (char c : {'\0', '"', '}', '9', '-', '\\'}) {
      std::string changed = text;
      changed[i] = c;
      errorOf(changed);  // an error or a project; no other outcome is allowed
    }
}

}  // namespace
}  // namespace palpa::modeling

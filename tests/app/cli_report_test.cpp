// palpa-cli report: the numbers of solve and touch, in a file that needs nothing else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

class CliReport : public testing::Test {
 protected:
  Outcome report(const std::string& arguments) const {
    return cli_.run("report " + arguments, PALPA_WITH_DISPLAY);
  }

  /// The object of a report that must succeed.
  Json reportJson(const std::string& arguments) const {
    const Outcome outcome = report(arguments + " --json");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return outcome.json();
  }

  Runner cli_;
};

Json exampleJson(const std::string& name) {
  std::ifstream file(std::filesystem::path(PALPA_PROJECTS) / name);
  return Json::parse(file);
}

/// Without what differs from run to run.
Json lasting(Json state) {
  for (const char* key : {"seconds", "memory_MiB", "touch"}) state.erase(key);
  return state;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++number;
  return number;
}

TEST_F(CliReport, HasTheNumbersOfSolveAndTouch) {
  const std::string project = Runner::example("box.json");
  const Json made = reportJson(project + " -o box.html");
  EXPECT_EQ(made.at("file"), "box.html");
  const std::string html = cli_.read("box.html");
  EXPECT_EQ(made.at("bytes"), static_cast<double>(html.size()));
  EXPECT_EQ(lasting(made.at("rest")), lasting(cli_.runJson("solve " + project)));
  EXPECT_EQ(lasting(made.at("together")), lasting(cli_.runJson("touch " + project)));
  ASSERT_EQ(made.at("alone").size(), 2u);
  EXPECT_EQ(made.at("alone")[0].at("touch"), "press the top");

  // Rounded as in the text of touch: every force with its error stands in the file.
  const std::string text = cli_.run("touch " + project).out;
  const std::regex withError("\\|([^|]+)\\| N");
  int found = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), withError), end; it != end; ++it, ++found)
    EXPECT_NE(html.find("|" + (*it)[1].str() + "| N"), std::string::npos) << it->str();
  EXPECT_EQ(found, 3);  // two touches, one support
}

TEST_F(CliReport, ATouchAloneActsAsInAProjectOfItsOwn) {
  // Two touches at places that are far apart, on the mesh for both; alone each has the force that
  // it has in a project without the other, up to the errors of the two meshes.
  const std::string box = Runner::example("box.json");
  const Json alone = reportJson(box + " -o box.html").at("alone");
  Json project = exampleJson("box.json");
  for (std::size_t k = 0; k < 2; ++k) {
    Json single = project;
    single["touches"] = Json::array({project["touches"][k]});
    cli_.writeJson("single.json", single);
    const Json own = cli_.runJson("touch single.json").at("contacts")[0];
    const Json& here = alone[k].at("contacts")[0];
    const double error =
        own.at("error_estimate").get<double>() + here.at("error_estimate").get<double>();
    EXPECT_NEAR(here.at("stiffness_N_per_mm").get<double>(),
                own.at("stiffness_N_per_mm").get<double>(),
                error * own.at("stiffness_N_per_mm").get<double>());
    EXPECT_GT(alone[k].at("largest_displacement").at("u_mm").get<double>(), 0.1);
  }
  // The model is linear: grabs alone and together exert other forces.
  EXPECT_NE(alone[0].at("contacts")[0].at("force_N"),
            cli_.runJson("touch " + box).at("contacts")[0].at("force_N"));
}

TEST_F(CliReport, NeedsNoOtherFile) {
  reportJson(Runner::example("box.json") + " -o box.html");
  const std::string html = cli_.read("box.html");
  // At rest, two touches, both together.
  EXPECT_EQ(count(html, "<img "), 4u);
  EXPECT_EQ(count(html, "src=\"data:image/png;base64,"), 4u);
  EXPECT_EQ(count(html, "src="), 4u);
  for (const char* outside : {"<script", "<link", "http://", "https://", "url(", "@import"})
    EXPECT_EQ(count(html, outside), 0u) << outside;
  for (const char* part :
       {"press the top", "pull the corner region", "soft silicone", "base", "Supports", "Loads",
        "Notices", "What the model assumes", "Sum of all forces", "582 elements"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

TEST_F(CliReport, TextOfUsersIsText) {
  Json project = exampleJson("cylinder.json");
  project["name"] = "<script>alert('x')</script> & \"co\"";
  project["touches"][0]["name"] = "</td><img src=x onerror=alert(1)>";
  project["material"]["name"] = "a <b>";
  project["supports"][0]["name"] = "<i>base";
  cli_.writeJson("p.json", project);
  reportJson("p.json --edge-length 10 -o p.html");
  const std::string html = cli_.read("p.html");
  for (const char* raw : {"<script", "<img src=x", "a <b>", "<i>"})
    EXPECT_EQ(count(html, raw), 0u) << raw;
  for (const char* text :
       {"&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt; &amp; &quot;co&quot;",
        "&lt;/td&gt;&lt;img src=x onerror=alert(1)&gt;", "a &lt;b&gt;", "&lt;i&gt;base"})
    EXPECT_GT(count(html, text), 0u) << text;
}

TEST_F(CliReport, TakesTouchesOfTheCommandLineAndLoadsAlone) {
  cli_.run("new box --edge-length 8 -o p.json");
  const Json touched = reportJson("p.json --place auto --depth 1% -o p.html");
  EXPECT_EQ(touched.at("together").at("contacts").size(), 1u);
  EXPECT_EQ(touched.at("alone").size(), 0u);
  EXPECT_EQ(count(cli_.read("p.html"), "<img "), 2u);

  Json project = cli_.readJson("p.json");
  project["loads"] = Json::array({{{"name", "weight on top"},
                                   {"kind", "pressure"},
                                   {"where", {{"patches", {"top"}}}},
                                   {"MPa", 0.001}}});
  cli_.writeJson("loaded.json", project);
  const Json loaded = reportJson("loaded.json -o loaded.html");
  EXPECT_FALSE(loaded.contains("together"));
  EXPECT_EQ(lasting(loaded.at("rest")), lasting(cli_.runJson("solve loaded.json")));
  EXPECT_NE(cli_.read("loaded.html").find("weight on top"), std::string::npos);
}

TEST_F(CliReport, ComparesVariantsInPictures) {
  Json project = exampleJson("box.json");
  project["material"]["youngs_modulus_MPa"] =
      2 * project["material"]["youngs_modulus_MPa"].get<double>();
  project["material"]["name"] = "<twice>";
  cli_.writeJson("stiff.json", project);
  const std::string compare = "compare " + Runner::example("box.json") + " stiff.json ";
  const Outcome page = cli_.run(compare + "-o c.html --json", PALPA_WITH_DISPLAY);
  ASSERT_EQ(page.exitCode, 0) << page.err;
  const std::string html = cli_.read("c.html");
  EXPECT_EQ(count(html, "src=\"data:image/png;base64,"), 2u);
  EXPECT_EQ(count(html, "src="), 2u);
  EXPECT_EQ(count(html, "<twice>"), 0u);
  EXPECT_GT(count(html, "&lt;twice&gt;"), 0u);
  // Twice the modulus, twice the force of a given displacement.
  EXPECT_NE(html.find("+100.0 %"), std::string::npos);
  EXPECT_EQ(lasting(page.json()), lasting(cli_.runJson(compare)));

  EXPECT_EQ(cli_.run(compare + "-o c.png", PALPA_WITH_DISPLAY).exitCode, 0);
  const std::string png = cli_.read("c.png");
  ASSERT_GT(png.size(), 24u);
  // Width and height: two pictures of 1000 x 900.
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x07\xD0\0\0\x03\x84", 8));
  EXPECT_EQ(cli_.run(compare + "-o c.txt").exitCode, 2);
}

TEST_F(CliReport, SaysWhyThereIsNone) {
  cli_.run("new box --edge-length 8 -o p.json");
  const std::string box = Runner::example("box.json");
  const Outcome nothing = report("p.json -o p.html");
  EXPECT_EQ(nothing.exitCode, 3);
  EXPECT_NE(nothing.err.find("no touches and no loads"), std::string::npos) << nothing.err;
  const Outcome pdf = report(box + " -o p.pdf");
  EXPECT_EQ(pdf.exitCode, 2);
  EXPECT_NE(pdf.err.find("print the .html file in a browser"), std::string::npos) << pdf.err;
  EXPECT_EQ(report(box + " -o p.txt").exitCode, 2);
  EXPECT_EQ(report(box + " --node 3 --displace 0,0,-1 -o p.html").exitCode, 2);
  EXPECT_EQ(report(box + " -o no/such/folder/p.html").exitCode, 3);
  Json free = exampleJson("box.json");
  free["supports"] = Json::array();
  cli_.writeJson("free.json", free);
  EXPECT_EQ(report("free.json -o p.html").exitCode, 4);
  EXPECT_FALSE(std::filesystem::exists(cli_.path("p.html")));
  cli_.write("old.html", "old");
  EXPECT_EQ(report("free.json -o old.html").exitCode, 4);
  EXPECT_EQ(cli_.read("old.html"), "old");
  const Outcome blind =
      cli_.run("report " + box + " -o p.html", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(blind.exitCode, 3) << blind.err;
}

}  // namespace
}  // namespace palpa::cli_tests

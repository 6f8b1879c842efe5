// Pages that can be touched, opened in a browser: they show the forces that palpa-cli touch
// reports.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

/// What the page writes about touches that its address asks for.
Json inBrowser(const Runner& runner, const std::string& page, const Json& request) {
  std::string asked;
  for (const char c : request.dump()) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", static_cast<unsigned char>(c));
    asked += text;
  }
  const std::string folder = runner.path("browser").string();
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-quic "
      "--no-first-run --disable-background-networking --disable-component-update --disable-sync "
      "--user-data-dir='" +
      folder + "' --dump-dom 'file://" + runner.path(page).string() + "#selftest=" + asked +
      "' >'" + runner.path("dom.txt").string() + "' 2>'" + runner.path("browser.txt").string() +
      "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << runner.read("browser.txt");
  const std::string dom = runner.read("dom.txt"), begin = "<pre id=\"selftest\">";
  const std::size_t first = dom.find(begin);
  EXPECT_NE(first, std::string::npos) << runner.read("browser.txt");
  if (first == std::string::npos) return {};
  const std::size_t from = first + begin.size();
  return Json::parse(dom.substr(from, dom.find("</pre>", from) - from));
}

Json vectorOf(double x, double y, double z) {
  return Json{x, y, z};
}

double distance(const Json& a, const Json& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += std::pow(a.at(k).get<double>() - b.at(k).get<double>(), 2);
  return std::sqrt(sum);
}

std::string text(const Json& vector) {
  std::string joined;
  for (const Json& each : vector) joined += (joined.empty() ? "" : ",") + each.dump();
  return joined;
}

TEST(Page, ForcesInTheBrowserAreThoseOfTouch) {
  ASSERT_EQ(std::system("command -v chromium >/dev/null"), 0)
      << "the package chromium is missing (packages.txt)";
  const Runner runner;
  const Json made = runner
                        .runJson("export " + Runner::example("cylinder.json") +
                                 " --engine quadratic --edge-length 8 -o touch.html --places 120")
                        .at("page");
  EXPECT_LT(made.at("bytes").get<double>(), 15e6);
  EXPECT_EQ(made.at("places"), 120);
  // On the side of the cylinder (radius 20 mm) and on its top (z = 60 mm).
  Json touches = Json::array();
  for (int k = 0; k < 6; ++k) {
    const double angle = 1.1 * k, x = std::cos(angle), y = std::sin(angle);
    touches.push_back(Json::array({Json{{"at", vectorOf(20 * x, 20 * y, 20 + 6.3 * k)},
                                        {"displacement", vectorOf(-x, -y + 0.2, 0.3)}}}));
  }
  touches.push_back(
      Json::array({Json{{"at", vectorOf(5, 4, 60)}, {"displacement", vectorOf(0.2, 0, -1)}},
                   Json{{"at", vectorOf(-20, 0, 25)}, {"displacement", vectorOf(1, 0, 0)}}}));
  const Json answer = inBrowser(runner, "touch.html", {{"touches", touches}});
  ASSERT_EQ(answer.at("results").size(), touches.size());
  for (std::size_t k = 0; k < touches.size(); ++k) {
    std::string arguments =
        "touch " + Runner::example("cylinder.json") + " --engine quadratic --edge-length 8";
    for (const Json& touch : touches[k])
      arguments += " --at=" + text(touch["at"]) + " --displace=" + text(touch["displacement"]) +
                   " --radius " + made.at("radius_mm").dump();
    const Json exact = runner.runJson(arguments).at("contacts");
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const Json& found = answer["results"][k][i];
      const Json& force = exact[i].at("force_N");
      SCOPED_TRACE("touch " + std::to_string(k) + ": " + force.dump() + found.dump());
      EXPECT_LT(distance(force, found.at("force_N")), found.at("page_error_N").get<double>());
      // Of several touches on a slender body the stated error can be as large as the forces.
      if (exact.size() == 1) {
        EXPECT_LT(found.at("error_N").get<double>(), 0.5 * norm(force));
      }
    }
  }
}

TEST(Page, OptionsArePagesOwn) {
  const Runner runner;
  const std::string project = "export " + Runner::example("cylinder.json");
  EXPECT_NE(runner.run(project + " -o a.step --places 50").err.find("name the file .html"),
            std::string::npos);
  EXPECT_NE(runner.run(project + " -o a.html --places 3").err.find("--places: expected 8 to 1000"),
            std::string::npos);
  EXPECT_NE(runner.run(project + " -o a.html --page-size 0.1").err.find("--page-size"),
            std::string::npos);
  EXPECT_NE(runner.run(project + " -o a.json").err.find("palpa-cli convert"), std::string::npos);
}

}  // namespace
}  // namespace palpa::cli_tests

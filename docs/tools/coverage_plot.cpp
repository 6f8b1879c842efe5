// coverage_plot RESULTS PICTURE.png: draws stated against true errors of random bodies, and the
// share of cases below each ratio, for the lines of JSON that palpa-coverage writes. See
// scripts/make-coverage. Needs a display.
#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/view/charts/log_chart.h"

namespace {

using namespace palpa::view::charts;

struct Errors {
  std::vector<double> stated, real;
};

/// By engine.
std::map<std::string, Errors> readErrors(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<std::string, Errors> errors;
  for (std::string line; std::getline(file, line);) {
    const auto result = nlohmann::json::parse(line);
    if (!result.contains("variants")) continue;
    for (const auto& [variant, of] : result["variants"].items()) {
      if (!of.contains("stated")) continue;
      Errors& engine = errors[variant.substr(0, variant.find(' '))];
      engine.stated.push_back(of["stated"]);
      engine.real.push_back(of["true"]);
    }
  }
  if (errors.empty()) throw std::runtime_error("no results in " + path);
  return errors;
}

void draw(const std::map<std::string, Errors>& errors, const std::string& path) {
  TwoCharts charts(std::string("stated = true").size());
  Range real, stated, ratios, shares;
  shares.add(0.01);
  shares.add(1);
  std::size_t index = 0;
  for (const auto& [engine, of] : errors) {
    std::vector<double> sorted, below;
    for (std::size_t k = 0; k < of.real.size(); ++k) {
      real.add(of.real[k]);
      stated.add(of.stated[k]);
      sorted.push_back(of.stated[k] / of.real[k]);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      ratios.add(sorted[k]);
      below.push_back(static_cast<double>(k + 1) / static_cast<double>(sorted.size()));
    }
    const Colour& colour = kColours[index++ % kColours.size()];
    addCurve(charts.chart(0), of.real, of.stated,
             {engine, colour, vtkPen::NO_PEN, vtkPlotPoints::CIRCLE, kLineWidth});
    addCurve(charts.chart(1), sorted, below,
             {engine, colour, vtkPen::SOLID_LINE, vtkPlotPoints::NONE, kLineWidth});
  }
  const std::vector<double> equal{std::pow(10, real.lower), std::pow(10, real.upper)};
  const Look line{"stated = true", kGrey, vtkPen::DASH_LINE, vtkPlotPoints::NONE, kLineWidth};
  addCurve(charts.chart(0), equal, equal, line);
  addCurve(charts.chart(1), {1, 1}, {0.01, 1}, line);
  charts.setAxes(0, real, "true error", stated, "stated error");
  charts.setAxes(1, ratios, "stated over true error", shares, "share of cases with less");
  charts.write(path);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Draws stated against true errors"};
  std::string results, picture;
  options.add_option("results", results)->required();
  options.add_option("picture", picture)->required();
  CLI11_PARSE(options, argc, argv);
  try {
    draw(readErrors(results), picture);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coverage_plot: %s\n", error.what());
    return 1;
  }
}

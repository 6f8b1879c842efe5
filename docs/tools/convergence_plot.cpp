// convergence_plot TABLE PICTURE.png [--body NAME]… [--engine NAME]…: draws the error of the
// convergence study against the number of coefficients and against the time to a solution, for the
// named bodies and engines (all without names). See scripts/make-convergence. Needs a display.
#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/view/charts/log_chart.h"

namespace {

using namespace palpa::view::charts;

struct Curve {
  std::string body, engine;
  std::vector<double> coefficients, seconds, errors;

  bool isTriangles() const { return engine.starts_with("triangles"); }
  bool isAdapted() const { return engine.find(',') != std::string::npos; }
};

/// The header names the columns; see tests/spline/study/study_series.h.
std::vector<Curve> readCurves(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<Curve> curves;
  std::string line;
  std::map<std::string, std::size_t> columns;
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::istringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ';');) cells.push_back(cell);
    if (columns.empty()) {
      for (std::size_t k = 0; k < cells.size(); ++k) columns[cells[k]] = k;
      continue;
    }
    const auto number = [&](const char* name) { return std::stod(cells.at(columns.at(name))); };
    const std::string &body = cells.at(columns.at("body")),
                      &engine = cells.at(columns.at("engine"));
    if (curves.empty() || curves.back().body != body || curves.back().engine != engine)
      curves.push_back({body, engine, {}, {}, {}});
    curves.back().coefficients.push_back(number("n"));
    curves.back().seconds.push_back(number("assemble_s") + number("factorise_s"));
    curves.back().errors.push_back(number("error"));
  }
  return curves;
}

Look lookOf(const Curve& curve, const std::vector<std::string>& bodies) {
  if (bodies.size() > 1) {
    const auto index = std::find(bodies.begin(), bodies.end(), curve.body) - bodies.begin();
    return {curve.body + ": " + curve.engine.substr(0, curve.engine.find_first_of(" ,")),
            kColours[static_cast<std::size_t>(index) % kColours.size()],
            curve.isTriangles() ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE,
            curve.isTriangles() ? vtkPlotPoints::SQUARE : vtkPlotPoints::CIRCLE, kLineWidth};
  }
  const Colour& colour = curve.isTriangles()                 ? kColours[1]
                         : curve.engine.starts_with("cubic") ? kColours[0]
                                                             : kColours[2];
  return {curve.engine, colour, curve.isAdapted() ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE,
          curve.isAdapted() ? vtkPlotPoints::DIAMOND : vtkPlotPoints::CIRCLE, kLineWidth};
}

/// A line of error ~ n^(-order / 2).
void addOrder(vtkChartXY* chart, const Range& along, const Range& errors, int order) {
  addSlope(chart, along, errors, -order / 2.0,
           {"slope of order " + std::to_string(order), kGrey,
            order == 2 ? vtkPen::DOT_LINE : vtkPen::DASH_DOT_LINE, vtkPlotPoints::NONE, 1.5F});
}

void draw(const std::vector<Curve>& curves, const std::string& path) {
  std::vector<std::string> bodies;
  Range coefficients, seconds, errors;
  for (const Curve& curve : curves) {
    if (std::find(bodies.begin(), bodies.end(), curve.body) == bodies.end())
      bodies.push_back(curve.body);
    for (std::size_t k = 0; k < curve.errors.size(); ++k) {
      coefficients.add(curve.coefficients[k]);
      seconds.add(curve.seconds[k]);
      errors.add(curve.errors[k]);
    }
  }
  std::size_t longest = 0;
  for (const Curve& curve : curves) longest = std::max(longest, lookOf(curve, bodies).label.size());
  TwoCharts charts(longest);
  for (const int index : {0, 1})
    for (const Curve& curve : curves)
      addCurve(charts.chart(index), index == 1 ? curve.seconds : curve.coefficients, curve.errors,
               lookOf(curve, bodies));
  for (const int order : {2, 4}) addOrder(charts.chart(0), coefficients, errors, order);
  charts.setAxes(0, coefficients, "n", errors, "relative error of u");
  charts.setAxes(1, seconds, "assembly and factorisation, s", errors, "relative error of u");
  charts.write(path);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Draws the convergence study"};
  std::string table, picture;
  std::vector<std::string> bodies, engines;
  options.add_option("table", table)->required();
  options.add_option("picture", picture)->required();
  options.add_option("--body", bodies);
  options.add_option("--engine", engines);
  CLI11_PARSE(options, argc, argv);
  try {
    std::vector<Curve> curves = readCurves(table);
    std::erase_if(curves, [&](const Curve& curve) {
      const auto lacks = [](const std::vector<std::string>& list, const std::string& name) {
        return !list.empty() && std::find(list.begin(), list.end(), name) == list.end();
      };
      return lacks(bodies, curve.body) || lacks(engines, curve.engine);
    });
    if (curves.empty()) throw std::runtime_error("no such curves in " + table);
    draw(curves, picture);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "convergence_plot: %s\n", error.what());
    return 1;
  }
}

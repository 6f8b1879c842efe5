// performance_plot TABLE PICTURE.png --body NAME --chart X:Y --chart X:Y: draws the measurements of
// palpa-peer-bench (its --table) for a body, one curve per method, and prints for every method the
// exponents of the straight lines in both charts, method;exponent;exponent. X and Y name
// values of the table. See scripts/bench. Needs a display.
#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "app/view/charts/log_chart.h"

namespace {

using namespace palpa::view::charts;

const std::map<std::string, std::string> kTitles{{"n", "n, nodes or coefficients of the surface"},
                                                 {"setup", "from edit to touch, s"},
                                                 {"memory", "memory, MiB"},
                                                 {"touch", "new touch, ms"},
                                                 {"kelvin", "relative error of u"}};
const std::map<std::string, double> kUnits{{"memory", 1.0 / (1 << 20)}, {"touch", 1e3}};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Values of all rounds by method, mesh and name; methods in the order of the file, meshes from
/// coarse to fine.
struct Measured {
  std::vector<std::string> methods;
  std::map<std::string, std::map<double, std::map<std::string, std::vector<double>>>> values;

  Measured(const std::string& path, const std::string& body) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    for (std::string line; std::getline(file, line);) {
      std::vector<std::string> cells;
      std::istringstream rest(line);
      for (std::string cell; std::getline(rest, cell, ';');) cells.push_back(cell);
      if (cells.size() != 6 || cells[0] != body || cells[4] == "note") continue;
      if (std::find(methods.begin(), methods.end(), cells[1]) == methods.end())
        methods.push_back(cells[1]);
      values[cells[1]][-std::stod(cells[2])][cells[4]].push_back(std::stod(cells[5]));
    }
    if (methods.empty()) throw std::runtime_error("no " + body + " in " + path);
  }

  /// Empty if the method does not have it.
  std::vector<double> series(const std::string& method, const std::string& name) const {
    const auto unit = kUnits.find(name);
    std::vector<double> result;
    for (const auto& [size, row] : values.at(method))
      if (const auto found = row.find(name); found != row.end())
        result.push_back(median(found->second) * (unit == kUnits.end() ? 1 : unit->second));
    return result;
  }
};

/// Slope of the straight line through the logarithms (least squares); NaN for fewer than two
/// points.
double exponent(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double a = std::log(x[k]), b = std::log(y[k]);
    n += 1;
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return n < 2 ? NAN : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void draw(const Measured& measured, const std::vector<std::string>& wanted,
          const std::string& path) {
  std::size_t longest = 0;
  for (const std::string& method : measured.methods) longest = std::max(longest, method.size());
  TwoCharts charts(longest);
  std::map<std::string, std::vector<double>> exponents;
  for (int index = 0; index < 2; ++index) {
    const auto split = wanted[index].find(':');
    const std::string x = wanted[index].substr(0, split), y = wanted[index].substr(split + 1);
    Range along, across;
    for (std::size_t m = 0; m < measured.methods.size(); ++m) {
      const std::string& method = measured.methods[m];
      const auto xs = measured.series(method, x), ys = measured.series(method, y);
      if (xs.size() != ys.size()) {
        exponents[method].push_back(NAN);
        continue;
      }
      for (std::size_t k = 0; k < xs.size(); ++k) {
        along.add(xs[k]);
        across.add(ys[k]);
      }
      const bool isOurs = method.starts_with("Palpa");
      addCurve(
          charts.chart(index), xs, ys,
          {method, kColours[m % kColours.size()], isOurs ? vtkPen::SOLID_LINE : vtkPen::DASH_LINE,
           isOurs ? vtkPlotPoints::CIRCLE : vtkPlotPoints::SQUARE, kLineWidth});
      exponents[method].push_back(exponent(xs, ys));
    }
    charts.setAxes(index, along, kTitles.at(x), across, kTitles.at(y));
  }
  charts.write(path);
  for (const std::string& method : measured.methods)
    std::printf("%s;%.2f;%.2f\n", method.c_str(), exponents[method][0], exponents[method][1]);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Draws the comparison with peers"};
  std::string table, picture, body;
  std::vector<std::string> charts;
  options.add_option("table", table)->required();
  options.add_option("picture", picture)->required();
  options.add_option("--body", body)->required();
  options.add_option("--chart", charts)->required()->expected(2);
  CLI11_PARSE(options, argc, argv);
  try {
    draw(Measured(table, body), charts, picture);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "performance_plot: %s\n", error.what());
    return 1;
  }
}

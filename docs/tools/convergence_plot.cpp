// convergence_plot TABLE PICTURE.png [--body NAME]… [--engine NAME]…: draws the error of the
// convergence study against the number of coefficients and against the time to a solution, for the
// named bodies and engines (all without names). See scripts/make-convergence. Needs a display.
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int kHeight = 520, kPlotWidth = 500;        // pixels
constexpr int kLegendRest = 60, kCharacterWidth = 7;  // pixels, beside the labels and in them
constexpr int kFontSize = 15;
constexpr float kLeftOffset = 11, kBottomOffset = 8;  // pixels, of labels from the axis
constexpr float kLineWidth = 2.2F, kMarkerSize = 9;
constexpr double kMargin = 0.06;  // of a decade, around the curves

using Colour = std::array<unsigned char, 3>;
/// Okabe and Ito's, which colour-blind people can tell apart.
constexpr std::array<Colour, 6> kColours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};
constexpr Colour kGrey{90, 90, 90};

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

/// Both coordinates are logarithms: VTK's own logarithmic axes choose labels of their own.
struct Range {
  double lower = INFINITY, upper = -INFINITY;
  void add(double value) {
    lower = std::min(lower, std::log10(value) - kMargin);
    upper = std::max(upper, std::log10(value) + kMargin);
  }
};

void styleText(vtkTextProperty* text) {
  text->SetFontSize(kFontSize);
  text->SetColor(0.1, 0.1, 0.1);
  text->SetBold(false);
}

/// Ticks at the powers of ten in a range, and at 2 and 5 times these when there are few of them.
void styleAxis(vtkAxis* axis, const Range& range, float labelOffset, const char* title) {
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  const bool isShort = range.upper - range.lower < 2.3;
  for (int power = static_cast<int>(std::floor(range.lower)); power <= range.upper; ++power)
    for (const int factor : {1, 2, 5}) {
      if (factor != 1 && !isShort) continue;
      const double at = power + std::log10(factor);
      if (at < range.lower || at > range.upper) continue;
      char label[32];
      std::snprintf(label, sizeof label, "%.4g", factor * std::pow(10.0, power));
      positions->InsertNextValue(at);
      labels->InsertNextValue(label);
    }
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(range.lower, range.upper);
  axis->SetCustomTickPositions(positions, labels);
  axis->SetTitle(title);
  styleText(axis->GetLabelProperties());
  styleText(axis->GetTitleProperties());
  axis->SetLabelOffset(labelOffset);
  axis->GetGridPen()->SetColor(225, 225, 225);
}

struct Look {
  std::string label;
  Colour colour;
  int line, marker;
  float width;
};

void addCurve(vtkChartXY* chart, const std::vector<double>& along,
              const std::vector<double>& errors, const Look& look) {
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName(look.label.c_str());
  for (std::size_t k = 0; k < along.size(); ++k) {
    x->InsertNextValue(std::log10(along[k]));
    y->InsertNextValue(std::log10(errors[k]));
  }
  table->AddColumn(x);
  table->AddColumn(y);
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::LINE));
  plot->SetInputData(table, 0, 1);
  plot->SetColor(look.colour[0], look.colour[1], look.colour[2], 255);
  plot->SetWidth(look.width);
  plot->GetPen()->SetLineType(look.line);
  plot->SetMarkerStyle(look.marker);
  plot->SetMarkerSize(kMarkerSize);
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

/// Straight lines of error ~ n^(-order / 2) through the lower left, within the ranges.
void addSlope(vtkChartXY* chart, const Range& along, const Range& errors, int order) {
  const double rise = order / 2.0;
  const double top = std::min(errors.upper, errors.lower + rise * (along.upper - along.lower));
  char label[64];
  std::snprintf(label, sizeof label, "slope of order %d", order);
  addCurve(chart,
           {std::pow(10, along.lower), std::pow(10, along.lower + (top - errors.lower) / rise)},
           {std::pow(10, top), std::pow(10, errors.lower)},
           {label, kGrey, order == 2 ? vtkPen::DOT_LINE : vtkPen::DASH_DOT_LINE,
            vtkPlotPoints::NONE, 1.5F});
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
  const int legendWidth = kLegendRest + kCharacterWidth * static_cast<int>(longest);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetDPI(72);  // a point of a font is a pixel
  window->SetSize(2 * kPlotWidth + legendWidth, kHeight);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  window->AddRenderer(renderer);
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkContextScene> scene;
  actor->SetScene(scene);
  scene->SetRenderer(renderer);
  renderer->AddActor(actor);
  for (const bool isTime : {false, true}) {
    vtkNew<vtkChartXY> chart;
    scene->AddItem(chart);
    chart->SetAutoSize(false);
    // The legend stands beside the right plot.
    chart->SetSize(
        isTime ? vtkRectf(kPlotWidth, 0, static_cast<float>(kPlotWidth + legendWidth), kHeight)
               : vtkRectf(0, 0, kPlotWidth, kHeight));
    const Range& along = isTime ? seconds : coefficients;
    for (const Curve& curve : curves)
      addCurve(chart, isTime ? curve.seconds : curve.coefficients, curve.errors,
               lookOf(curve, bodies));
    if (!isTime)
      for (const int order : {2, 4}) addSlope(chart, along, errors, order);
    styleAxis(chart->GetAxis(vtkAxis::BOTTOM), along, kBottomOffset,
              isTime ? "assembly and factorisation, s" : "n");
    styleAxis(chart->GetAxis(vtkAxis::LEFT), errors, kLeftOffset, "relative error of u");
    chart->SetForceAxesToBounds(false);
    chart->SetShowLegend(isTime);
    vtkChartLegend* legend = chart->GetLegend();
    legend->SetInline(false);
    legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    legend->SetVerticalAlignment(vtkChartLegend::CENTER);
    styleText(legend->GetLabelProperties());
  }
  // The space for the labels is known once something was drawn.
  for (int round = 0; round < 2; ++round) window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0) throw std::runtime_error("cannot write " + path);
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

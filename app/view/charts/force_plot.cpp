#include "app/view/charts/force_plot.h"

#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "app/view/scene/ticks.h"

namespace palpa::view {
namespace {

constexpr double kFontSize = 11;  // logical pixels
constexpr double kLineWidth = 1.8, kDashWidth = 1.3;
constexpr double kHeadroom = 1.08;
constexpr double kTickSpacing = 34;     // logical pixels between two numbers, about
constexpr double kLegendLine = 17;      // logical pixels
constexpr double kCountSpacing = 32;    // logical pixels between two whole numbers, about
constexpr double kFittedMargin = 0.12;  // of the range of the values
constexpr double kMinForce = 1e-9;      // below it all curves are zero

/// Okabe and Ito's, which colour-blind people can tell apart; the dark blue last, which a dark
/// background swallows.
constexpr std::array<std::array<unsigned char, 3>, 6> kColours{
    {{213, 94, 0}, {86, 180, 233}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {0, 114, 178}}};

/// Whole numbers, as many as there is space for.
void setCounts(vtkAxis& axis, double begin, double end, double width) {
  const double most = std::max(2.0, width / kCountSpacing);
  double step = 1;
  for (const double factor : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0})  // 1, 2, 5, 10, 20, 50, 100
    if ((end - begin) / step > most) step *= factor;
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (double at = std::ceil(begin / step) * step; at <= end; at += step) {
    positions->InsertNextValue(at);
    labels->InsertNextValue(std::to_string(std::lround(at)));
  }
  axis.SetCustomTickPositions(positions, labels);
}

}  // namespace

struct ForcePlot::Parts {
  vtkRenderWindow* window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkContextActor> actor;
  vtkNew<vtkChartXY> chart;
  ViewportTheme theme = ViewportTheme::light();
  double ratio = 1;
  bool hasLegend = false, isFitted = false, isCounting = false;

  void updateLooks() {
    renderer->SetBackground(theme.backgroundTop.data());
    const auto style = [this](vtkTextProperty* text) {
      text->SetColor(theme.text[0], theme.text[1], theme.text[2]);
      text->SetFontSize(static_cast<int>(std::lround(kFontSize * ratio)));
      text->SetBold(false);
    };
    for (const int side : {vtkAxis::LEFT, vtkAxis::BOTTOM}) {
      vtkAxis* axis = chart->GetAxis(side);
      style(axis->GetLabelProperties());
      style(axis->GetTitleProperties());
      axis->GetPen()->SetColorF(theme.text[0], theme.text[1], theme.text[2], 0.6);
      axis->GetGridPen()->SetColorF(theme.grid[0], theme.grid[1], theme.grid[2], 0.8);
      axis->GetPen()->SetWidth(static_cast<float>(ratio));
      axis->GetGridPen()->SetWidth(static_cast<float>(ratio));
    }
    vtkChartLegend* legend = chart->GetLegend();
    style(legend->GetLabelProperties());
    legend->GetBrush()->SetColorF(theme.backgroundTop[0], theme.backgroundTop[1],
                                  theme.backgroundTop[2], 0.8);
    legend->GetPen()->SetColorF(theme.text[0], theme.text[1], theme.text[2], 0.3);
  }
};

std::array<unsigned char, 3> ForcePlot::colour(int number) {
  return kColours[static_cast<std::size_t>(number) % kColours.size()];
}

void ForcePlot::setLegendShown(bool shown) {
  parts_->hasLegend = shown;
}

void ForcePlot::setFitted(bool isFitted) {
  parts_->isFitted = isFitted;
}

void ForcePlot::setCounting(bool isCounting) {
  parts_->isCounting = isCounting;
}

void ForcePlot::setHorizontalTitle(const std::string& title) {
  parts_->chart->GetAxis(vtkAxis::BOTTOM)->SetTitle(title);
}

ForcePlot::ForcePlot(vtkRenderWindow* window) : parts_(std::make_unique<Parts>()) {
  parts_->window = window;
  window->SetMultiSamples(0);
  window->SetDPI(72);  // a point of a font is a pixel
  vtkNew<vtkContextScene> scene;
  scene->AddItem(parts_->chart);
  parts_->actor->SetScene(scene);
  scene->SetRenderer(parts_->renderer);
  parts_->renderer->AddActor(parts_->actor);
  parts_->chart->SetAutoSize(true);
  // Otherwise the data limit the axes, and a force that hardly changes would fill the plot.
  parts_->chart->SetForceAxesToBounds(false);
  parts_->chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::LEFT);
  parts_->chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
  parts_->chart->GetAxis(vtkAxis::BOTTOM)->SetTitle("time, s");
  for (const int side : {vtkAxis::LEFT, vtkAxis::BOTTOM})
    parts_->chart->GetAxis(side)->SetBehavior(vtkAxis::FIXED);
  window->AddRenderer(parts_->renderer);
  parts_->updateLooks();
}

ForcePlot::~ForcePlot() {
  parts_->window->RemoveRenderer(parts_->renderer);
}

void ForcePlot::setTheme(const ViewportTheme& theme) {
  parts_->theme = theme;
  parts_->updateLooks();
}

void ForcePlot::setPixelRatio(double ratio) {
  if (ratio == parts_->ratio) return;
  parts_->ratio = ratio;
  parts_->updateLooks();
}

void ForcePlot::setCurves(const std::vector<Curve>& curves, double begin, double end,
                          const std::string& unit) {
  vtkChartXY* chart = parts_->chart;
  chart->ClearPlots();
  chart->SetShowLegend(parts_->hasLegend);
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Curve& curve = curves[i];
    if (curve.times.size() != curve.forces.size())
      throw std::invalid_argument("force plot: a curve needs one force per time");
    if (curve.times.size() < 2) continue;
    vtkNew<vtkTable> table;
    vtkNew<vtkFloatArray> times, forces;
    times->SetName("time");
    forces->SetName(curve.name.c_str());
    for (std::size_t k = 0; k < curve.times.size(); ++k) {
      times->InsertNextValue(static_cast<float>(curve.times[k]));
      forces->InsertNextValue(static_cast<float>(curve.forces[k]));
      largest = std::max(largest, curve.forces[k]);
      smallest = std::min(smallest, curve.forces[k]);
    }
    table->AddColumn(times);
    table->AddColumn(forces);
    vtkPlot* plot = chart->AddPlot(vtkChart::LINE);
    plot->SetInputData(table, 0, 1);
    const auto [r, g, b] = colour(curve.number);
    plot->SetColor(r, g, b, 255);
    plot->SetWidth(static_cast<float>((curve.isDashed ? kDashWidth : kLineWidth) * parts_->ratio));
    if (curve.isDashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  }
  vtkAxis* bottom = chart->GetAxis(vtkAxis::BOTTOM);
  bottom->SetRange(begin, end);
  if (parts_->isCounting) {
    const double width = std::max(1, parts_->window->GetSize()[0]) / parts_->ratio;
    setCounts(*bottom, begin, end, width);
  }
  vtkAxis* left = chart->GetAxis(vtkAxis::LEFT);
  if (largest < kMinForce) largest = 1;  // nothing: an axis of nanonewtons would only puzzle
  // Round numbers, and at least two of them, however small the plot is.
  const double height = std::max(1, parts_->window->GetSize()[1]) / parts_->ratio;
  double top = kHeadroom * largest;
  if (parts_->hasLegend) {
    const double legend = kLegendLine * static_cast<double>(curves.size() + 1);
    top *= height / std::max(0.3 * height, height - legend);
  }
  double base = 0;
  if (parts_->isFitted && smallest < largest) {
    base = smallest - kFittedMargin * (largest - smallest);
    top = largest + kFittedMargin * (largest - smallest);
  }
  left->SetRange(base, top);
  const Ticks ticks =
      niceTicks(base, top, std::clamp(static_cast<int>(height / kTickSpacing), 2, 8));
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (std::size_t k = 0; k < ticks.values.size(); ++k) {
    positions->InsertNextValue(ticks.values[k]);
    labels->InsertNextValue(ticks.labels[k]);
  }
  left->SetCustomTickPositions(positions, labels);
  left->SetTitle(scaledUnit(unit, ticks.exponent).name);
  chart->RecalculateBounds();
}

void ForcePlot::render() {
  parts_->window->Render();
}

}  // namespace palpa::view

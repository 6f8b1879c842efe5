#include "app/view/charts/log_chart.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkContextActor.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cstdio>

#include "app/view/files/png.h"

namespace palpa::view::charts {
namespace {

constexpr int kHeight = 520, kPlotWidth = 500;        // pixels
constexpr int kLegendRest = 60, kCharacterWidth = 7;  // pixels, beside the labels and in them
constexpr int kFontSize = 15;
constexpr float kLeftOffset = 11, kBottomOffset = 8;  // pixels, of labels from the axis
constexpr float kMarkerSize = 9;
constexpr double kMargin = 0.06;  // of a decade, around the curves

void styleText(vtkTextProperty* text) {
  text->SetFontSize(kFontSize);
  text->SetColor(0.1, 0.1, 0.1);
  text->SetBold(false);
}

/// Ticks at the powers of ten in a range, and at 2 and 5 times these when there are few of them.
void styleAxis(vtkAxis* axis, const Range& range, float labelOffset, const std::string& title) {
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

}  // namespace

void Range::add(double value) {
  lower = std::min(lower, std::log10(value) - kMargin);
  upper = std::max(upper, std::log10(value) + kMargin);
}

void addCurve(vtkChartXY* chart, const std::vector<double>& along,
              const std::vector<double>& values, const Look& look) {
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> x, y;
  x->SetName("x");
  y->SetName(look.label.c_str());
  for (std::size_t k = 0; k < along.size(); ++k) {
    x->InsertNextValue(std::log10(along[k]));
    y->InsertNextValue(std::log10(values[k]));
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

void addSlope(vtkChartXY* chart, const Range& along, const Range& values, double exponent,
              const Look& look) {
  const double steepness = std::abs(exponent);
  const double height =
      std::min(values.upper - values.lower, steepness * (along.upper - along.lower));
  const double begin = exponent < 0 ? along.lower : along.upper;
  const double end = begin - height / exponent;
  addCurve(chart, {std::pow(10, begin), std::pow(10, end)},
           {std::pow(10, values.lower + height), std::pow(10, values.lower)}, look);
}

TwoCharts::TwoCharts(std::size_t longest) {
  const int legendWidth = kLegendRest + kCharacterWidth * static_cast<int>(longest);
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetDPI(72);  // a point of a font is a pixel
  window_->SetSize(2 * kPlotWidth + legendWidth, kHeight);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  window_->AddRenderer(renderer);
  vtkNew<vtkContextActor> actor;
  actor->SetScene(scene_);
  scene_->SetRenderer(renderer);
  renderer->AddActor(actor);
  for (const int index : {0, 1}) {
    vtkChartXY* chart = charts_[index];
    scene_->AddItem(chart);
    chart->SetAutoSize(false);
    // The legend stands beside the right chart.
    chart->SetSize(
        index == 1 ? vtkRectf(kPlotWidth, 0, static_cast<float>(kPlotWidth + legendWidth), kHeight)
                   : vtkRectf(0, 0, kPlotWidth, kHeight));
    chart->SetForceAxesToBounds(false);
    chart->SetShowLegend(index == 1);
    vtkChartLegend* legend = chart->GetLegend();
    legend->SetInline(false);
    legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    legend->SetVerticalAlignment(vtkChartLegend::CENTER);
    styleText(legend->GetLabelProperties());
  }
}

void TwoCharts::setAxes(int index, const Range& along, const std::string& alongTitle,
                        const Range& values, const std::string& valuesTitle) {
  styleAxis(charts_[index]->GetAxis(vtkAxis::BOTTOM), along, kBottomOffset, alongTitle);
  styleAxis(charts_[index]->GetAxis(vtkAxis::LEFT), values, kLeftOffset, valuesTitle);
}

void TwoCharts::write(const std::filesystem::path& path) {
  // The space for the labels is known once something was drawn.
  for (int round = 0; round < 2; ++round) window_->Render();
  writePng(window_, path);
}

}  // namespace palpa::view::charts

#include "app/view/charts/convergence_plot.h"

#include <vtkPen.h>
#include <vtkPlotPoints.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "app/view/charts/log_chart.h"
#include "app/view/files/display.h"

namespace palpa::view {
namespace {

using namespace charts;

constexpr float kSlopeWidth = 1.5F;

void check(const std::vector<ErrorCurve>& curves) {
  const auto isPositive = [](double value) { return value > 0 && std::isfinite(value); };
  if (curves.empty() || curves.size() > kColours.size())
    throw std::invalid_argument("convergence plot: expected one to six curves");
  for (const ErrorCurve& curve : curves) {
    if (curve.errors.empty() || curve.coefficients.size() != curve.errors.size() ||
        curve.sizes.size() != curve.errors.size())
      throw std::invalid_argument("convergence plot: a curve needs lists of equal lengths");
    for (const auto* list : {&curve.coefficients, &curve.sizes, &curve.errors})
      if (!std::all_of(list->begin(), list->end(), isPositive))
        throw std::invalid_argument("convergence plot: logarithms need positive numbers");
  }
}

}  // namespace

void drawConvergence(const std::vector<ErrorCurve>& curves, const std::filesystem::path& path) {
  check(curves);
  requireDisplay();
  Range coefficients, sizes, errors;
  std::set<int> orders;
  std::size_t longest = std::string("slope of order 2").size();
  for (const ErrorCurve& curve : curves) {
    for (std::size_t k = 0; k < curve.errors.size(); ++k) {
      coefficients.add(curve.coefficients[k]);
      sizes.add(curve.sizes[k]);
      errors.add(curve.errors[k]);
    }
    orders.insert(curve.order);
    longest = std::max(longest, curve.name.size());
  }
  TwoCharts both(longest);
  for (const bool isBySize : {false, true}) {
    vtkChartXY* chart = both.chart(isBySize);
    for (std::size_t k = 0; k < curves.size(); ++k)
      addCurve(
          chart, isBySize ? curves[k].sizes : curves[k].coefficients, curves[k].errors,
          {curves[k].name, kColours[k], vtkPen::SOLID_LINE, vtkPlotPoints::CIRCLE, kLineWidth});
    for (const int order : orders)
      // On a surface n grows like the inverse square of the size.
      addSlope(chart, isBySize ? sizes : coefficients, errors, isBySize ? order : -order / 2.0,
               {"slope of order " + std::to_string(order), kGrey,
                order == *orders.begin() ? vtkPen::DOT_LINE : vtkPen::DASH_DOT_LINE,
                vtkPlotPoints::NONE, kSlopeWidth});
  }
  both.setAxes(0, coefficients, "nodes or control points", errors, "relative error of u");
  both.setAxes(1, sizes, "size of the elements, mm", errors, "relative error of u");
  both.write(path);
}

}  // namespace palpa::view

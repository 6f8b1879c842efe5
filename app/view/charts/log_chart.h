#pragma once

#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

/// Charts with two logarithmic axes, side by side in a picture with one legend: for plots of errors
/// and the pages in docs/. Needs a display. Internal to app/view and docs/tools.
namespace palpa::view::charts {

using Colour = std::array<unsigned char, 3>;
/// Okabe and Ito's, which colour-blind people can tell apart.
inline constexpr std::array<Colour, 6> kColours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};
inline constexpr Colour kGrey{90, 90, 90};

/// Both coordinates are logarithms: VTK's logarithmic axes do not let the caller choose labels.
struct Range {
  double lower = INFINITY, upper = -INFINITY;
  void add(double value);
};

struct Look {
  std::string label;
  Colour colour;
  int line, marker;  ///< of vtkPen and vtkPlotPoints
  float width;
};
inline constexpr float kLineWidth = 2.2F;

void addCurve(vtkChartXY* chart, const std::vector<double>& along,
              const std::vector<double>& values, const Look& look);

/// The straight line of value ~ along^exponent that begins in the upper corner on its side and ends
/// within the ranges.
void addSlope(vtkChartXY* chart, const Range& along, const Range& values, double exponent,
              const Look& look);

/// Two charts and the legend of the right one beside them.
class TwoCharts {
 public:
  /// `longest`: characters of the longest label.
  explicit TwoCharts(std::size_t longest);
  vtkChartXY* chart(int index) { return charts_[index]; }
  void setAxes(int index, const Range& along, const std::string& alongTitle, const Range& values,
               const std::string& valuesTitle);
  /// Throws ViewError if the file cannot be written.
  void write(const std::filesystem::path& path);

 private:
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkContextScene> scene_;
  std::array<vtkNew<vtkChartXY>, 2> charts_;
};

}  // namespace palpa::view::charts

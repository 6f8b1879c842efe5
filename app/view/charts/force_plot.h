#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

class vtkRenderWindow;

namespace palpa::view {

/// Forces over time, or over another quantity, as curves, drawn into a render window given by the
/// caller. Not thread-safe.
class ForcePlot {
 public:
  /// The window's OpenGL context, if it has one, must be current here and in the destructor.
  explicit ForcePlot(vtkRenderWindow* window);
  ~ForcePlot();

  struct Curve {
    std::string name;
    int number = 0;              ///< gives the colour, see colour()
    std::vector<double> times;   ///< s, ascending
    std::vector<double> forces;  ///< one per time, in `unit` of setCurves()
    bool isDashed = false;       ///< for a wanted value
  };
  /// Of curves with this number: red, green, blue; number 6 has the colour of 0.
  static std::array<unsigned char, 3> colour(int number);
  /// Names of the curves, above all of them: for a picture without other explanation.
  void setLegendShown(bool shown);
  /// Of the horizontal axis; "time, s" at first.
  void setHorizontalTitle(const std::string& title);
  /// The vertical axis encloses the values instead of beginning at zero.
  void setFitted(bool isFitted);
  /// The horizontal axis counts: its numbers are whole.
  void setCounting(bool isCounting);
  /// Shows the times from `begin` to `end`. Throws std::invalid_argument for arrays of unequal
  /// lengths.
  void setCurves(const std::vector<Curve>& curves, double begin, double end,
                 const std::string& unit);
  void setTheme(const ViewportTheme& theme);
  /// Device pixels per logical pixel.
  void setPixelRatio(double ratio);
  void render();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpa::view

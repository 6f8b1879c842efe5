#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/view/viewport_scene.h"

class vtkRenderWindow;

namespace palpa::view {

/// Forces over time as curves, drawn into a render window given by the caller. Not thread-safe.
class ForcePlot {
 public:
  /// The window's OpenGL context, when it has one, must be current here and in the destructor.
  explicit ForcePlot(vtkRenderWindow* window);
  ~ForcePlot();

  struct Curve {
    std::string name;
    int number = 0;              ///< gives the colour, see colour()
    std::vector<double> times;   ///< s, ascending
    std::vector<double> forces;  ///< one per time, in `unit` of setCurves()
  };
  /// Of curves with this number, red, green, blue; there are six, which then begin again.
  static std::array<unsigned char, 3> colour(int number);
  /// Names of the curves in the picture, above all of them; where nothing else says what they are.
  void setLegendShown(bool shown);
  /// Shows the times from `begin` to `end`; std::invalid_argument for arrays of unequal lengths.
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

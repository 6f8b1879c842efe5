#pragma once

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
    std::vector<double> times;   ///< s, ascending
    std::vector<double> forces;  ///< one per time, in `unit` of setCurves()
  };
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

#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "app/view/camera/bounds.h"
#include "app/view/camera/turntable.h"
#include "app/view/layers/vtk_arrays.h"

/// The ground grid. Internal to app/view.
namespace palpa::view {

/// Distance between the lines of the grid, mm.
double gridSpacing(const Turntable& camera, double pixelRatio);

/// Height of the grid's plane: 0, or below a body that reaches deeper, in steps that suit its size,
/// so that the grid neither cuts the body nor follows every small move.
double groundLevel(const Bounds& body);

/// A horizontal grid around the focus of the camera, fading outwards; its spacing follows the
/// zoom. Every tenth line is stronger; the x and y axes are coloured.
class GridActor {
 public:
  explicit GridActor(vtkRenderer* renderer);

  void setVisible(bool visible);
  void setTheme(const ViewportTheme& theme);
  void setPixelRatio(double ratio);
  /// To be called before drawing.
  void update(const Turntable& camera, double level);

 private:
  /// Lines of one width with a colour per point.
  struct Lines {
    vtkSmartPointer<vtkPoints> points;
    vtkSmartPointer<vtkUnsignedCharArray> colours;
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkActor> actor;
  };
  /// A disc of the ground: lines fade towards its border.
  struct Area {
    Eigen::Vector2d center;
    double radius;
    double level;
  };

  static Lines makeLines(vtkRenderer* renderer);
  static void clear(Lines& lines);
  static void finish(Lines& lines);
  static void addLine(const Area& area, int axis, double at, const Colour& colour, double opacity,
                      Lines& lines);

  Lines grid_, axes_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view

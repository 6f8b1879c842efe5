#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>
#include <functional>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Drawings of tools, and touches. Internal to app/view.
namespace palpa::view {

/// Words on plates.
class PlateLabels {
 public:
  explicit PlateLabels(vtkRenderer* overlay) : texts_(overlay) {}

  void set(const std::vector<std::string>& texts, const ViewportTheme& theme, double pixelRatio);
  /// Places the text of that index beside `pixel`; NaN hides it.
  void place(std::size_t index, const Eigen::Vector2d& pixel, const Colour& frame,
             const Turntable& camera, FlatShapes& shapes);

 private:
  TextPool texts_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

/// Lines, dots and labels of the active tool.
class ToolLayer {
 public:
  ToolLayer(vtkRenderer* scene, vtkRenderer* overlay);

  void set(const ToolDrawing& drawing, const ViewportTheme& theme, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`.
  void update(const Turntable& camera, FlatShapes& shapes);

  /// Ends of the lines: the depth range includes them.
  const std::vector<Eigen::Vector3d>& ends() const { return ends_; }

 private:
  /// The lines of one style that the body may hide.
  struct Lines {
    vtkSmartPointer<vtkPoints> points;
    vtkSmartPointer<vtkActor> actor;
  };

  ToolDrawing drawing_;
  std::array<Lines, 4> lines_;  ///< by style
  std::vector<Eigen::Vector3d> ends_;
  PlateLabels labels_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

/// Dots with arrows at the places of touches, faint behind the body.
class TouchLayer {
 public:
  explicit TouchLayer(vtkRenderer* overlay) : labels_(overlay) {}

  void set(const std::vector<TouchMarker>& markers, const ViewportTheme& theme, double pixelRatio);
  void setVisible(bool visible) { visible_ = visible; }
  /// To be called before drawing, between clear() and finish() of `shapes`; `hidden` tells whether
  /// the body lies before a point.
  void update(const Turntable& camera, const std::function<bool(const Eigen::Vector3d&)>& hidden,
              FlatShapes& shapes);

 private:
  std::vector<TouchMarker> markers_;
  PlateLabels labels_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
  bool visible_ = true;
};

}  // namespace palpa::view

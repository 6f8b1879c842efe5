#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Core>
#include <vector>

#include "app/view/layers/vtk_arrays.h"

/// Flat shapes. Internal to app/view.
namespace palpa::view {

/// Between words and the border of their plate, logical pixels.
inline const Eigen::Vector2d kPlatePad(6, 4);

/// Coloured polygons in one actor of an overlay, added again for every picture. Pixels are counted
/// from the top left corner of the picture; later shapes cover earlier ones.
class FlatShapes {
 public:
  explicit FlatShapes(vtkRenderer* overlay);

  /// Removes all shapes; `height` of the picture in pixels.
  void clear(int height);
  /// Convex.
  void addPolygon(const std::vector<Eigen::Vector2d>& corners, const Colour& colour,
                  double opacity = 1);
  void addLine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
               const Colour& colour, double opacity = 1);
  void addDisc(const Eigen::Vector2d& center, double radius, const Colour& colour,
               double opacity = 1);
  void addRectangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Colour& colour,
                    double opacity = 1);
  /// A frame of the given width just inside the rectangle.
  void addFrame(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
                const Colour& colour, double opacity = 1);
  /// The ground of words, with a frame of that opacity.
  void addPlate(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Colour& frame,
                const ViewportTheme& theme, double pixelRatio, double frameOpacity = 0.7);
  /// To be called after all shapes.
  void finish();

 private:
  int height_ = 1;
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkUnsignedCharArray> colours_;
  vtkSmartPointer<vtkPolyData> data_;
};

}  // namespace palpa::view

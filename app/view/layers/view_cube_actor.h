#pragma once

#include <vtkActor2D.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <array>
#include <optional>

#include "app/view/camera/view_cube.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/scene/theme.h"

/// The view cube. Internal to app/view.
namespace palpa::view {

/// A cube in the upper right corner that turns with the camera, with a word on each face and four
/// arrows around it. Hidden at first.
class ViewCubeActor {
 public:
  explicit ViewCubeActor(vtkRenderer* overlay);

  void setVisible(bool visible);
  bool isVisible() const { return visible_; }
  void setHovered(const std::optional<ViewCubePart>& part) { hovered_ = part; }
  void setTheme(const ViewportTheme& theme, double pixelRatio);
  /// To be called before drawing, between clear() and finish() of `shapes`.
  void update(const Turntable& camera, FlatShapes& shapes);

 private:
  /// The word of a face: its picture on a parallelogram.
  struct Word {
    Eigen::Vector3i face;
    vtkSmartPointer<vtkPolyData> quad;
    vtkSmartPointer<vtkTexture> texture;
    vtkSmartPointer<vtkActor2D> actor;
    Eigen::Vector2d share;  ///< of the face that it covers, along and up
  };

  void drawWords();

  std::array<Word, 6> words_;
  std::optional<ViewCubePart> hovered_;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
  bool visible_ = false;
  bool areWordsDrawn_ = false;
};

}  // namespace palpa::view

#pragma once

#include <vtkRenderer.h>

#include <optional>
#include <vector>

#include "app/view/camera/turntable.h"
#include "app/view/layers/arrow_labels.h"
#include "app/view/layers/dimension_pen.h"
#include "app/view/layers/flat_shapes.h"
#include "app/view/layers/text_pool.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Dimensions. Internal to app/view.
namespace palpa::view {

/// Dimension lines with extension lines, arrows and a plate with the number, of fixed size in
/// pixels, over everything. Plates stay inside the picture and beside the plates drawn before.
class DimensionLayer {
 public:
  explicit DimensionLayer(vtkRenderer* overlay) : texts_(overlay) {}

  void set(const std::vector<Dimension>& dimensions, const ViewportTheme& theme, double pixelRatio);
  void setVisible(bool visible) { visible_ = visible; }
  /// To be called before drawing, between clear() and finish() of `shapes`. Dimension lines lie on
  /// the side away from `centre`, the middle of the body.
  void update(const Turntable& camera, const Eigen::Vector3d& centre, std::vector<PixelBox>& taken,
              FlatShapes& shapes);
  /// The dimension whose plate is at a pixel of the last picture.
  std::optional<int> at(const Eigen::Vector2d& pixel) const;

 private:
  struct Frame;
  /// A dimension line ends at `mid`; the plate lies there, or moved along `way` or across it.
  struct PlateWish {
    Eigen::Vector2d mid, way;
    bool isBeside = false;  ///< beside `mid` in the direction of `way`, not on it
  };
  std::optional<PlateWish> drawLinear(const Dimension& dimension, const Frame& frame,
                                      DimensionPen& pen) const;
  std::optional<PlateWish> drawAngle(const Dimension& dimension, const Frame& frame,
                                     DimensionPen& pen) const;
  std::optional<PlateWish> drawRadius(const Dimension& dimension, const Frame& frame,
                                      DimensionPen& pen) const;
  std::optional<PlateWish> drawCurve(const Dimension& dimension, const Frame& frame,
                                     DimensionPen& pen) const;
  PixelBox placePlate(std::size_t index, const PlateWish& wish, const Eigen::Vector2d& picture,
                      const std::vector<PixelBox>& taken) const;

  TextPool texts_;
  std::vector<Dimension> dimensions_;
  std::vector<PixelBox> plates_;  // of the last picture; empty boxes for hidden ones
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
  bool visible_ = true;
};

}  // namespace palpa::view

#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

#include "app/view/viewport_scene.h"

/// Arrows as solid bodies, for the interactive view. Internal to app/view.
namespace palpa::view {

/// An arrow with the radii that belong to its length.
struct SolidArrow {
  Eigen::Vector3d tail, tip;  ///< apart
  double shaftRadius;         ///< mm
  double headRadius;
  double headLength;
  Colour colour{};

  /// In the proportions of pictures with a body of that diagonal; smaller in all directions where
  /// it is too short for its head.
  static SolidArrow of(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip, double diagonal,
                       const Colour& colour);
};

/// Any number of arrows as one surface, which is written anew when they move: one actor draws them
/// all. An actor each costs more than everything else in the picture when there are dozens.
class ArrowMesh {
 public:
  ArrowMesh();

  void set(const std::vector<SolidArrow>& arrows);
  vtkPolyData* surface() const { return surface_; }

 private:
  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> normals_;
  vtkSmartPointer<vtkUnsignedCharArray> colours_;
  vtkSmartPointer<vtkPolyData> surface_;
  std::size_t count_ = 0;
};

}  // namespace palpa::view

#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Arrows as solid bodies. Internal to app/view.
namespace palpa::view {

/// Thickness, in diagonals of the body.
inline constexpr double kArrowShaftRadius = 0.0045;
inline constexpr double kArrowHeadRadius = 0.0126;
inline constexpr double kArrowHeadLength = 0.0372;

/// An arrow with the radii for its length.
struct SolidArrow {
  Eigen::Vector3d tail, tip;  ///< apart
  double shaftRadius;         ///< mm
  double headRadius;
  double headLength;
  Colour colour{};
  /// mm; above 0 the arrow has no head, but a curved arrow of this radius about its axis.
  double turnRadius = 0;
  double turnAt = 0;  ///< place of the curved arrow, as a share of the way from tail to tip

  /// As thick as suits a body of that diagonal, the same for all arrows; smaller in all directions
  /// where it is too short for its head.
  static SolidArrow of(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip, double diagonal,
                       const Colour& colour);
  /// The same for a moment about the axis from tail to tip.
  static SolidArrow turning(const Eigen::Vector3d& tail, const Eigen::Vector3d& tip, double turnAt,
                            double diagonal, const Colour& colour);
};

/// Centre of the curved arrow of a moment, as a share of the way from the held to the free end.
inline constexpr double kTurnAt = 0.6;
/// Radius of the curved arrow, in diagonals of the body, and at most a share of the length.
inline constexpr double kTurnRadius = 0.05;
inline constexpr double kMaxTurnShare = 0.45;

/// Any number of arrows as one surface, so that one actor draws them: dozens of actors cost more
/// than everything else in the picture.
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
  std::vector<char> strips_;  ///< kinds of the strips that have triangles
};

}  // namespace palpa::view

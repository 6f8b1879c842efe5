#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "app/view/scene/scene.h"

/// A large body with fewer triangles. Internal to app/view.
namespace palpa::view {

/// Stands for a body with many triangles while something moves: some ten thousand triangles between
/// points of the body, which have the numbers of these points and follow them.
class CoarseSurface {
 public:
  /// Bodies with more triangles have a coarse surface.
  static constexpr std::size_t kManyTriangles = 60'000;

  CoarseSurface();

  /// Takes another body. Costs tenths of a second with 200,000 triangles, nothing for small
  /// bodies.
  void setBody(const ViewportBody& body);
  /// True for a body that is not large.
  bool isEmpty() const { return pointOf_.empty(); }
  /// With the arrays of follow() and smooth normals within patches.
  vtkPolyData* data() const { return data_; }
  /// Takes the places and all named arrays of the points of the body, and the scalars of its
  /// triangles. `body`: with the points and triangles of setBody().
  void follow(vtkPolyData* body);

 private:
  void updateNormals();

  vtkSmartPointer<vtkPolyData> data_;
  std::vector<Triangle> triangles_;
  std::vector<vtkIdType> pointOf_;     ///< of the body, per point
  std::vector<vtkIdType> triangleOf_;  ///< of the body, per triangle
  vtkMTimeType followed_ = 0;          ///< time of the body's data
};

}  // namespace palpa::view

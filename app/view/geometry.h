#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "app/view/scene.h"

/// From scenes to VTK's surfaces. Internal to app/view.
namespace palpa::view {

/// The undeformed surface with the point arrays "field" (when there is one) and "displacement"
/// (already scaled), so that whatever is cut out of it can still be deformed by `deform`.
vtkSmartPointer<vtkPolyData> referenceSurface(const SurfaceScene& scene);

/// The same with every point moved by its "displacement".
vtkSmartPointer<vtkPolyData> deform(vtkPolyData* reference);

/// The surface with points duplicated along edges sharper than `creaseAngle` (rad), and normals.
/// The triangles keep their order. Creases are found on `reference` and the normals on the deformed
/// shape, so that a deep dimple does not turn into a crease.
vtkSmartPointer<vtkPolyData> deformedWithNormals(vtkPolyData* reference, double creaseAngle);

/// The same for the undeformed shape.
vtkSmartPointer<vtkPolyData> undeformedWithNormals(vtkPolyData* reference, double creaseAngle);

/// The deformed surface with the given normals, one per point.
vtkSmartPointer<vtkPolyData> deformedWithNormals(vtkPolyData* reference,
                                                 const std::vector<Eigen::Vector3d>& normals);

/// The same surface with points of equal position put together: what lines are found on when points
/// are split at sharp edges. The triangles keep their order.
vtkSmartPointer<vtkPolyData> merged(vtkPolyData* reference);

/// Lines along all edges of triangles.
vtkSmartPointer<vtkPolyData> meshLines(vtkPolyData* reference);

/// Lines between pairs of points of the surface.
vtkSmartPointer<vtkPolyData> meshLines(vtkPolyData* reference,
                                       const std::vector<std::array<int, 2>>& pairs);

/// Lines along creases of the undeformed surface.
vtkSmartPointer<vtkPolyData> creaseLines(vtkPolyData* reference, double creaseAngle);

/// Lines along the border of a set of triangles.
vtkSmartPointer<vtkPolyData> borderLines(vtkPolyData* reference, const std::vector<int>& triangles);

/// The lines where the sphere of `patch` meets the undeformed surface.
vtkSmartPointer<vtkPolyData> contactLines(vtkPolyData* reference, const ContactPatch& patch);

/// A surface of the chosen triangles that shares the points of `surface`.
vtkSmartPointer<vtkPolyData> subset(vtkPolyData* surface, const std::vector<int>& triangles);

}  // namespace palpa::view

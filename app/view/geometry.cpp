#include "app/view/geometry.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkExtractEdges.h>
#include <vtkFeatureEdges.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkSphere.h>

#include <numbers>

#include "app/view/colour_map.h"

namespace palpa::view {
namespace {

constexpr const char* kField = "field";
constexpr const char* kDisplacement = "displacement";

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Lines between triangles that turn by more than `creaseAngle`, and free borders, as asked for.
vtkSmartPointer<vtkPolyData> edges(vtkPolyData* surface, bool creases, double creaseAngle) {
  vtkNew<vtkFeatureEdges> filter;
  filter->SetInputData(surface);
  filter->SetFeatureEdges(creases);
  filter->SetBoundaryEdges(!creases);
  filter->NonManifoldEdgesOff();
  filter->ManifoldEdgesOff();
  filter->ColoringOff();
  filter->SetFeatureAngle(degrees(creaseAngle));
  filter->Update();
  return filter->GetOutput();
}

}  // namespace

vtkSmartPointer<vtkPolyData> referenceSurface(const SurfaceScene& scene) {
  const auto pointCount = static_cast<vtkIdType>(scene.positions.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(pointCount);
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName(kDisplacement);
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(pointCount);
  for (vtkIdType i = 0; i < pointCount; ++i) {
    const auto k = static_cast<std::size_t>(i);
    points->SetPoint(i, scene.positions[k].data());
    const Eigen::Vector3d moved =
        scene.displacements.empty()
            ? Eigen::Vector3d(Eigen::Vector3d::Zero())
            : Eigen::Vector3d(scene.displacementScale * scene.displacements[k]);
    displacement->SetTuple(i, moved.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& triangle : scene.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  surface->GetPointData()->AddArray(displacement);
  if (scene.field) {
    vtkNew<vtkDoubleArray> values;
    values->SetName(kField);
    for (const double value : scene.field->values)
      values->InsertNextValue(colourNumber(*scene.field, value));
    surface->GetPointData()->SetScalars(values);
  }
  return surface;
}

vtkSmartPointer<vtkPolyData> deform(vtkPolyData* reference) {
  auto deformed = vtkSmartPointer<vtkPolyData>::New();
  deformed->ShallowCopy(reference);
  vtkDataArray* displacement = reference->GetPointData()->GetArray(kDisplacement);
  if (!displacement || !reference->GetPoints()) return deformed;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(reference->GetPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d position;
    Eigen::Vector3d moved;
    points->GetPoint(i, position.data());
    displacement->GetTuple(i, moved.data());
    position += moved;
    points->SetPoint(i, position.data());
  }
  deformed->SetPoints(points);
  return deformed;
}

vtkSmartPointer<vtkPolyData> undeformedWithNormals(vtkPolyData* reference, double creaseAngle) {
  vtkNew<vtkPolyDataNormals> splitter;
  splitter->SetInputData(reference);
  splitter->SplittingOn();
  splitter->SetFeatureAngle(degrees(creaseAngle));
  splitter->ConsistencyOff();
  splitter->AutoOrientNormalsOff();
  splitter->Update();
  return splitter->GetOutput();
}

vtkSmartPointer<vtkPolyData> deformedWithNormals(vtkPolyData* reference, double creaseAngle) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(deform(undeformedWithNormals(reference, creaseAngle)));
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->AutoOrientNormalsOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> deformedWithNormals(vtkPolyData* reference,
                                                 const std::vector<Eigen::Vector3d>& normals) {
  const auto surface = deform(reference);
  vtkNew<vtkDoubleArray> array;
  array->SetName("Normals");
  array->SetNumberOfComponents(3);
  for (const Eigen::Vector3d& normal : normals) array->InsertNextTuple(normal.data());
  surface->GetPointData()->SetNormals(array);
  return surface;
}

vtkSmartPointer<vtkPolyData> merged(vtkPolyData* reference) {
  vtkNew<vtkCleanPolyData> filter;
  filter->SetInputData(reference);
  filter->SetTolerance(0);
  filter->ConvertPolysToLinesOff();
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> meshLines(vtkPolyData* reference,
                                       const std::vector<std::array<int, 2>>& pairs) {
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : pairs) cells->InsertNextCell({a, b});
  auto lines = vtkSmartPointer<vtkPolyData>::New();
  lines->SetPoints(reference->GetPoints());
  lines->GetPointData()->ShallowCopy(reference->GetPointData());
  lines->SetLines(cells);
  return lines;
}

vtkSmartPointer<vtkPolyData> meshLines(vtkPolyData* reference) {
  vtkNew<vtkExtractEdges> filter;
  filter->SetInputData(reference);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> creaseLines(vtkPolyData* reference, double creaseAngle) {
  return edges(reference, true, creaseAngle);
}

vtkSmartPointer<vtkPolyData> borderLines(vtkPolyData* reference,
                                         const std::vector<int>& triangles) {
  return edges(subset(reference, triangles), false, 0);
}

vtkSmartPointer<vtkPolyData> contactLines(vtkPolyData* reference, const ContactPatch& patch) {
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(patch.center.x(), patch.center.y(), patch.center.z());
  sphere->SetRadius(patch.radius);
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(reference);
  cutter->SetCutFunction(sphere);
  cutter->Update();
  return cutter->GetOutput();
}

vtkSmartPointer<vtkPolyData> subset(vtkPolyData* surface, const std::vector<int>& triangles) {
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> corners;
  for (const int triangle : triangles) {
    surface->GetPolys()->GetCellAtId(triangle, corners);
    cells->InsertNextCell(corners);
  }
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(surface->GetPoints());
  part->GetPointData()->ShallowCopy(surface->GetPointData());
  part->SetPolys(cells);
  return part;
}

}  // namespace palpa::view

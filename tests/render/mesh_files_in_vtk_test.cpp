#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkXMLPolyDataReader.h>

#include "modeling/exchange/mesh_writer.h"

// Mesh files of Palpa, read by the readers of VTK.
namespace palpa {
namespace {

namespace fs = std::filesystem;

const modeling::MeshFile kTetrahedron{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}},
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
    {{"displacement_mm", 3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 1}}},
    {{"patch", 1, {0, 1, 2, 3}}}};

/// Number of points that the reader finds in a file with the tetrahedron.
template <class Reader>
vtkIdType pointsIn(const char* ending, vtkPolyData* result) {
  const fs::path path =
      fs::temp_directory_path() / ("palpa-vtk-" + std::to_string(getpid()) + ending);
  modeling::writeMesh(kTetrahedron, path);
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  result->ShallowCopy(reader->GetOutput());
  fs::remove(path);
  EXPECT_EQ(result->GetNumberOfCells(), 4);
  return result->GetNumberOfPoints();
}

TEST(MeshFilesInVtk, SurfacesComeBack) {
  vtkNew<vtkPolyData> mesh;
  EXPECT_EQ(pointsIn<vtkSTLReader>(".stl", mesh), 4);
  EXPECT_EQ(pointsIn<vtkOBJReader>(".obj", mesh), 4);
  EXPECT_EQ(pointsIn<vtkPLYReader>(".ply", mesh), 4);
  EXPECT_FLOAT_EQ(mesh->GetPoint(3)[2], 0.1F);
}

TEST(MeshFilesInVtk, DataComeBackInFull) {
  vtkNew<vtkPolyData> mesh;
  ASSERT_EQ(pointsIn<vtkXMLPolyDataReader>(".vtp", mesh), 4);
  EXPECT_EQ(mesh->GetPoint(3)[2], 0.1);
  EXPECT_EQ(mesh->GetCell(1)->GetPointId(2), 3);
  vtkDataArray* displacement = mesh->GetPointData()->GetArray("displacement_mm");
  ASSERT_TRUE(displacement);
  EXPECT_EQ(displacement->GetComponent(2, 1), 7);
  vtkDataArray* patch = mesh->GetCellData()->GetArray("patch");
  ASSERT_TRUE(patch);
  EXPECT_EQ(patch->GetComponent(3, 0), 3);
}

}  // namespace
}  // namespace palpa

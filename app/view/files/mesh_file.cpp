#include "app/view/mesh_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include "app/view/errors.h"

namespace palpa::view {
namespace {

constexpr std::array<const char*, 4> kEndings{".stl", ".obj", ".ply", ".vtp"};

std::string endingOf(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

void addData(const std::vector<MeshData>& data, vtkFieldData* target) {
  for (const MeshData& entry : data) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(entry.name.c_str());
    array->SetNumberOfComponents(entry.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(entry.values.size()) / entry.components);
    std::copy(entry.values.begin(), entry.values.end(), array->GetPointer(0));
    target->AddArray(array);
  }
}

vtkSmartPointer<vtkPolyData> toPolyData(const MeshFile& mesh, int precision) {
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (const Eigen::Vector3d& position : mesh.positions) points->InsertNextPoint(position.data());
  vtkNew<vtkCellArray> cells;
  for (const Triangle& triangle : mesh.triangles) {
    cells->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  addData(mesh.pointData, data->GetPointData());
  addData(mesh.triangleData, data->GetCellData());
  return data;
}

/// Runs a VTK writer; true when it reported no error.
template <class Writer>
bool writeWith(Writer* writer, vtkPolyData* data, const std::filesystem::path& path) {
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  // The caller turns a failure into an exception; VTK's own message would come on top of it.
  vtkObject::GlobalWarningDisplayOff();
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == 0;
  vtkObject::GlobalWarningDisplayOn();
  return written;
}

bool writeObj(const MeshFile& mesh, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "# lengths in mm\n";
  std::array<char, 128> line{};
  for (const Eigen::Vector3d& p : mesh.positions) {
    std::snprintf(line.data(), line.size(), "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
    file << line.data();
  }
  for (const Triangle& t : mesh.triangles) {
    file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  file.close();
  return file.good();
}

bool write(const MeshFile& mesh, const std::filesystem::path& path) {
  const std::string ending = endingOf(path);
  if (ending == ".obj") return writeObj(mesh, path);
  if (ending == ".stl") {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    return writeWith(writer.Get(), toPolyData(mesh, VTK_FLOAT), path);
  }
  if (ending == ".ply") {
    vtkNew<vtkPLYWriter> writer;
    writer->SetFileTypeToBinary();
    return writeWith(writer.Get(), toPolyData(mesh, VTK_FLOAT), path);
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  return writeWith(writer.Get(), toPolyData(mesh, VTK_DOUBLE), path);
}

}  // namespace

std::string meshFileEndings() {
  return ".stl, .obj, .ply or .vtp";
}

void requireMeshFileName(const std::filesystem::path& path) {
  if (std::find(kEndings.begin(), kEndings.end(), endingOf(path)) == kEndings.end()) {
    throw ViewError("cannot write a mesh to " + path.string() + ": the name must end in " +
                    meshFileEndings());
  }
}

void writeMesh(const MeshFile& mesh, const std::filesystem::path& path) {
  requireMeshFileName(path);
  // VTK's PLY writer does not report a file it cannot open.
  const bool writable = std::ofstream(path, std::ios::binary).is_open();
  if (!writable || !write(mesh, path)) {
    throw ViewError("cannot write the mesh " + path.string() +
                    "; check that its folder exists and can be written");
  }
}

}  // namespace palpa::view

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/view/scene.h"

namespace palpa::view {

/// Numbers that belong to points or triangles of a mesh file.
struct MeshData {
  std::string name;            ///< with the unit, e.g. "displacement_mm"
  int components = 1;          ///< numbers per point or triangle
  std::vector<double> values;  ///< components × count, point by point
};

/// A triangle mesh with data, as written to files. Positions in mm.
struct MeshFile {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<MeshData> pointData;     ///< written to .vtp only
  std::vector<MeshData> triangleData;  ///< written to .vtp only
};

/// The endings `writeMesh` knows, for messages: ".stl, .obj, .ply or .vtp".
std::string meshFileEndings();

/// Throws ViewError unless `path` ends in one of them.
void requireMeshFileName(const std::filesystem::path& path);

/// Writes binary STL, OBJ, binary PLY or VTP according to the file name's ending, replacing an
/// existing file. Throws ViewError when the ending is not known or the file cannot be written.
void writeMesh(const MeshFile& mesh, const std::filesystem::path& path);

}  // namespace palpa::view

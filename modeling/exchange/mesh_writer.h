#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace palpa::modeling {

/// Numbers that belong to vertices or triangles of a mesh file.
struct MeshData {
  std::string name;            ///< with the unit, e.g. "displacement_mm"
  int components = 1;          ///< numbers per vertex or triangle
  std::vector<double> values;  ///< components × count, vertex by vertex
};

/// A triangle mesh with data, as written to files. Positions in mm.
struct MeshFile {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<int, 3>> triangles;
  std::vector<MeshData> pointData;     ///< written to .vtp only
  std::vector<MeshData> triangleData;  ///< written to .vtp only
};

/// Writes a mesh in the format of the file's ending; an existing file remains until the new one is
/// complete. Throws ModelingError if the ending is not a format of isWritableMesh(), or (kind io)
/// if the file cannot be written.
void writeMesh(const MeshFile& mesh, const std::filesystem::path& path);

}  // namespace palpa::modeling

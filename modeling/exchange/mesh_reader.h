#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/job.h"
#include "modeling/body/mesh_body.h"

namespace palpa::modeling {

enum class MeshFormat { kStl, kObj, kPly };

struct MeshReadOptions {
  double scale =
      1.0;  ///< mm per unit of the file, finite and > 0; mesh files do not tell their unit
};

inline constexpr std::size_t kMaxMeshFile = 512U << 20U;  ///< bytes
inline constexpr int kMaxMeshTriangles = 4'000'000;
inline constexpr int kMaxPolygonCorners = 2'000;
inline constexpr int kMaxMeshFaces = 1'000;
inline constexpr int kMaxMeshShells = 200;  ///< closed surfaces: the body's and its cavities'

/// Reads a mesh file by its ending (.stl, .obj, .ply in any case; STL and PLY as text or binary)
/// and makes a body of it:
/// - polygons are cut into triangles, vertices at exactly the same place become one, triangles
///   without extent and doubled ones are left out; vertices of open edges are joined when they are
///   within 1e-6 of the body's size;
/// - triangles are turned so that all normals point out of the material, around cavities as well;
/// - faces: the groups of an OBJ file (the first of `g`, `o`, `usemtl` that tells two parts apart)
///   or the solids of an STL text; otherwise the parts between sharp edges, "face_1" the largest,
///   those below a thousandth of the surface joined to a neighbour.
///
/// Never makes a body that is not closed, cuts itself or consists of several pieces.
///
/// @throws ModelingError that begins with the file's name: not found, unreadable, larger than
///         kMaxMeshFile, a syntax error with its line or byte, counts that the file cannot
///         hold, numbers that are not finite, indices out of range, and what is wrong with the
///         surface with the number of places and the first of them; Cancelled.
/// Cost: about 6 s for a million triangles. Stops within a second when cancelled.
MeshBody readMeshFile(const std::filesystem::path& path, const MeshReadOptions& options = {},
                      const Job& job = {});

/// The same for a file's content; `sourceName` begins the messages.
MeshBody parseMesh(std::string_view bytes, MeshFormat format, const std::string& sourceName,
                   const MeshReadOptions& options = {}, const Job& job = {});

/// Does the ending name one of the formats?
bool isMeshFile(const std::filesystem::path& path);

/// The format that the ending names. @throws ModelingError for any other ending
MeshFormat meshFormatOf(const std::filesystem::path& path);

}  // namespace palpa::modeling

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/job.h"
#include "modeling/body/mesh_body.h"
#include "modeling/exchange/file_format.h"

namespace palpa::modeling {

/// Options of readMeshFile().
struct MeshReadOptions {
  double scale =
      1.0;  ///< mm per unit of the file, finite and > 0; mesh files do not state their unit
};

inline constexpr std::size_t kMaxMeshFile = 512U << 20U;  ///< bytes
inline constexpr int kMaxMeshTriangles = 4'000'000;
inline constexpr int kMaxPolygonCorners = 2'000;
inline constexpr int kMaxMeshFaces = 1'000;
inline constexpr int kMaxMeshShells = 200;  ///< closed surfaces: outer surface and cavities

/// Mesh body from a mesh file, whose format follows from its ending (.stl, .obj, .ply in upper or
/// lower case; STL and PLY as text or binary):
/// - Polygons are cut into triangles, vertices at exactly the same place are merged, triangles
///   without extent and duplicates are omitted; vertices of open edges are joined if they are
///   within 1e-6 of the body's size.
/// - Triangles are oriented so that all normals point out of the material, also around cavities.
/// - Faces are the groups of an OBJ file (of the first of `g`, `o`, `usemtl` with at least two
///   parts) or the solids of an STL text; otherwise the parts between sharp edges, "face_1" the
///   largest, where parts below a thousandth of the surface are joined to a neighbour.
///
/// The result is always closed, free of self-intersections and in one piece.
///
/// Throws ModelingError that begins with the file's name if the file does not exist, is unreadable
/// or larger than kMaxMeshFile, has a syntax error (with its line or byte), counts that exceed its
/// length, numbers that are not finite or indices out of range, or if its surface is faulty (with
/// the number of places and the first of them); Cancelled.
/// Cost: about 6 s for a million triangles. Stops within a second when cancelled.
MeshBody readMeshFile(const std::filesystem::path& path, const MeshReadOptions& options = {},
                      const Job& job = {});

/// The same for a file's content; `sourceName` begins the messages.
MeshBody parseMesh(std::string_view bytes, FileFormat format, const std::string& sourceName,
                   const MeshReadOptions& options = {}, const Job& job = {});

}  // namespace palpa::modeling

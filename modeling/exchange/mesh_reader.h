#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/job.h"
#include "modeling/body/mesh_body.h"
#include "modeling/exchange/file_bodies.h"
#include "modeling/exchange/file_format.h"

namespace palpa::modeling {

/// Options of readMeshFile().
struct MeshReadOptions {
  /// mm per unit of the file, finite and > 0; mesh files do not state their unit.
  double scale = 1.0;
  /// Number from 1 or name of the body in listMeshFile(); empty: the only one.
  std::string solid{};
  /// For the sizes in the message of SeveralBodies; the body itself is not rotated.
  UpAxis up = UpAxis::kZ;
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
/// - Closed surfaces with the cavities directly inside them are bodies; one of several is chosen.
///
/// The result is always closed, free of self-intersections and in one piece.
///
/// Throws ModelingError that begins with the file's name if the file does not exist, is unreadable
/// or larger than kMaxMeshFile, has a syntax error (with its line or byte), counts that exceed its
/// length, numbers that are not finite or indices out of range, or if its surface is faulty (with
/// the number of places and the first of them), or the chosen body is not in it; SeveralBodies;
/// Cancelled.
/// Cost: about 6 s for a million triangles. Stops within a second when cancelled.
MeshBody readMeshFile(const std::filesystem::path& path, const MeshReadOptions& options = {},
                      const Job& job = {});

/// The same for a file's content; `sourceName` begins the messages.
MeshBody parseMesh(std::string_view bytes, FileFormat format, const std::string& sourceName,
                   const MeshReadOptions& options = {}, const Job& job = {});

/// A mesh body, and the bodies among which it was chosen.
struct ChosenMesh {
  MeshBody body;
  FileBodies found;  ///< no bodies if the file has only one and none was chosen
  std::size_t index = 0;
};

/// As readMeshFile().
ChosenMesh chooseMesh(const std::filesystem::path& path, const MeshReadOptions& options,
                      const Job& job = {});

/// Reads the `count` bodies of a mesh file, which is read once, as readMeshFile() does with one,
/// and passes the body or the problem of each to `take`; `options.solid` has no meaning. Throws as
/// readMeshFile() if the file cannot be read.
using TakeMesh = std::function<void(std::size_t index, std::optional<ChosenMesh> chosen,
                                    const std::string& problem)>;
void readMeshBodies(const std::filesystem::path& path, const MeshReadOptions& options,
                    const TakeMesh& take, const Job& job = {});

/// The bodies of a mesh file, named after the group that contains them; with `scale` as in
/// MeshReadOptions. Throws as readMeshFile().
FileBodies listMeshFile(const std::filesystem::path& path, double scale, ListedSurface surface,
                        const Job& job = {});

}  // namespace palpa::modeling

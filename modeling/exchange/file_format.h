#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace palpa::modeling {

/// Formats of files with a body. kPage stays the last, so that a format without a row in
/// kFileFormats does not compile. Written lengths are in mm; lengths of CAD files are converted to
/// mm from the unit of the file (BREP files have no unit: mm).
enum class FileFormat {
  kProject,
  kStep,  ///< ISO 10303-21, application protocol 214
  kIges,  ///< version 5.3, manifold solid B-rep
  kBrep,  ///< text format of OpenCASCADE
  kStl,   ///< binary when written
  kObj,
  kPly,   ///< binary when written
  kVtp,   ///< ParaView's XML file of polygons with data
  kPage,  ///< a page for browsers that answers to touches, from a solved model
};

enum class FileKind { kProject, kCad, kMesh, kPage };

/// Names, endings and abilities of a format.
struct FileFormatInfo {
  FileFormat format;
  FileKind kind;
  const char* name;
  const char* use;                     ///< in the window, to be translated
  std::array<const char*, 2> endings;  ///< the usual one first; null: there is no second
  bool canRead = true;
  bool canWrite = true;
};

inline constexpr std::array<FileFormatInfo, 1 + static_cast<std::size_t>(FileFormat::kPage)>
    kFileFormats{{
        {FileFormat::kProject,
         FileKind::kProject,
         "Palpa project",
         "patches, to continue modelling",
         {".json", ".palpa"}},
        {FileFormat::kStep, FileKind::kCad, "STEP", "exact patches, for CAD", {".step", ".stp"}},
        {FileFormat::kIges,
         FileKind::kCad,
         "IGES",
         "exact patches, for older CAD",
         {".iges", ".igs"}},
        {FileFormat::kBrep, FileKind::kCad, "BREP", "exact patches, for OpenCASCADE", {".brep"}},
        {FileFormat::kStl, FileKind::kMesh, "STL", "triangles, for 3D printing", {".stl"}},
        {FileFormat::kObj, FileKind::kMesh, "OBJ", "triangles, for rendering", {".obj"}},
        {FileFormat::kPly, FileKind::kMesh, "PLY", "triangles", {".ply"}},
        {FileFormat::kVtp, FileKind::kMesh, "VTP", "triangles, for ParaView", {".vtp"}, false},
        {FileFormat::kPage,
         FileKind::kPage,
         "Touchable page",
         "to touch in a browser",
         {".html"},
         false},
    }};

constexpr const FileFormatInfo& infoOf(FileFormat format) {
  return kFileFormats[static_cast<std::size_t>(format)];
}

static_assert([] {
  for (const FileFormatInfo& info : kFileFormats)
    if (!info.name || infoOf(info.format).name != info.name) return false;
  return true;
}());

/// Selections of formats, for the functions below.
using FormatFilter = bool (*)(const FileFormatInfo&);
constexpr bool isProject(const FileFormatInfo& info) {
  return info.kind == FileKind::kProject;
}
constexpr bool isCad(const FileFormatInfo& info) {
  return info.kind == FileKind::kCad;
}
constexpr bool isReadable(const FileFormatInfo& info) {
  return info.canRead;
}
constexpr bool isImportable(const FileFormatInfo& info) {
  return info.canRead && info.kind != FileKind::kProject;
}
constexpr bool isReadableMesh(const FileFormatInfo& info) {
  return info.canRead && info.kind == FileKind::kMesh;
}
constexpr bool isPage(const FileFormatInfo& info) {
  return info.kind == FileKind::kPage;
}
/// Writable from a project alone, without a solved model.
constexpr bool isWritable(const FileFormatInfo& info) {
  return info.canWrite && !isPage(info);
}
/// What an export writes: a body without its supports, loads and touches, or a page of a model.
constexpr bool isExported(const FileFormatInfo& info) {
  return info.canWrite && info.kind != FileKind::kProject;
}
constexpr bool isWritableMesh(const FileFormatInfo& info) {
  return info.canWrite && info.kind == FileKind::kMesh;
}

/// The format for the ending of a file's name, in upper or lower case.
std::optional<FileFormat> fileFormatOf(const std::filesystem::path& path);

/// The same if it is one of the accepted formats. Throws ModelingError that lists their endings if
/// not.
FileFormat requireFormat(const std::filesystem::path& path, FormatFilter accepts);

/// The endings of the accepted formats, for messages: ".stl, .obj or .ply".
std::string endingsText(FormatFilter accepts);

/// The same for file dialogs: "*.stl *.obj *.ply".
std::string endingPatterns(FormatFilter accepts);

}  // namespace palpa::modeling

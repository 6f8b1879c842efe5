#include "modeling/exchange/mesh_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "base/text.h"
#include "modeling/body/smooth_regions.h"
#include "modeling/error.h"
#include "modeling/exchange/closed_surface.h"
#include "modeling/exchange/text_cursor.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

constexpr int kMaxFoundFaces = 100;
constexpr double kMinFace = 1e-3;  // of the whole area
constexpr std::size_t kMaxNameLength = 80;

PolygonSoup parseSoup(std::string_view bytes, FileFormat format, const Job& job) {
  switch (format) {
    case FileFormat::kStl:
      return parseStl(bytes, job);
    case FileFormat::kObj:
      return parseObj(bytes, job);
    case FileFormat::kPly:
      return parsePly(bytes, job);
    case FileFormat::kProject:
    case FileFormat::kStep:
    case FileFormat::kIges:
    case FileFormat::kBrep:
    case FileFormat::kVtp:
      break;
  }
  throw std::invalid_argument("parseMesh: not a readable mesh format");
}

/// A group's name as valid UTF-8, as project files need it: mesh files have no fixed encoding.
std::string faceName(std::string_view name) {
  std::string result(name.substr(0, kMaxNameLength));
  for (char& c : result)
    if (c < ' ' || c > '~') c = '_';
  return result;
}

/// Makes faces of the groups with triangles, in the order of the file. Names that are equal after
/// cleaning get a number.
void nameByGroups(const ClosedSurface& surface, const std::vector<std::string>& groupNames,
                  MeshBody::Data& data) {
  std::vector<int> faceOfGroup(groupNames.size(), -1);
  std::map<std::string, int> uses;
  for (int group : surface.groups) {
    if (faceOfGroup[group] >= 0) continue;
    faceOfGroup[group] = 0;
  }
  for (std::size_t g = 0; g < groupNames.size(); ++g) {
    if (faceOfGroup[g] < 0) continue;
    faceOfGroup[g] = static_cast<int>(data.faceNames.size());
    std::string name = faceName(groupNames[g]);
    if (name.empty()) name = "face";
    const std::string plain = name;
    while (++uses[name] > 1) name = plain + "_" + std::to_string(uses[plain]);
    data.faceNames.push_back(name);
  }
  if (data.faceNames.size() > static_cast<std::size_t>(kMaxMeshFaces))
    throw ModelingError("has " + std::to_string(data.faceNames.size()) + " groups; at most " +
                            std::to_string(kMaxMeshFaces) + " can become faces",
                        ModelingError::Kind::kTooLarge);
  for (int group : surface.groups) data.faceOfTriangle.push_back(faceOfGroup[group]);
}

void nameBySharpEdges(const ClosedSurface& surface, MeshBody::Data& data) {
  double twiceArea = 0.0;
  const auto& p = surface.positions;
  for (const auto& [a, b, c] : surface.triangles)
    twiceArea += (p[b] - p[a]).cross(p[c] - p[a]).norm();
  data.faceOfTriangle =
      smoothRegions(p, surface.triangles, 0.5 * kMinFace * twiceArea, kMaxFoundFaces);
  const int count = *std::max_element(data.faceOfTriangle.begin(), data.faceOfTriangle.end()) + 1;
  for (int face = 1; face <= count; ++face)
    data.faceNames.push_back("face_" + std::to_string(face));
}

/// The bytes of a text format without the mark that some editors put before UTF-8.
std::string_view plainText(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw ModelingError("is text in UTF-16, which is not read; save it as UTF-8 or ASCII");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return bytes;
}

MeshBody bodyFrom(std::string_view bytes, FileFormat format, const MeshReadOptions& options,
                  const Job& job) {
  if (!std::isfinite(options.scale) || options.scale <= 0.0)
    throw ModelingError("the scale " + numberText(options.scale) +
                        " must be finite and greater than 0");
  if (bytes.size() > kMaxMeshFile)
    throw ModelingError("has " + std::to_string(bytes.size()) + " bytes; at most " +
                            std::to_string(kMaxMeshFile) + " are read",
                        ModelingError::Kind::kTooLarge);
  job.report(Phase::kImport, 0.0);
  // The first 80 bytes of a binary STL file are arbitrary.
  const PolygonSoup soup =
      parseSoup(format == FileFormat::kStl ? bytes : plainText(bytes), format, job);
  job.report(Phase::kImport, 0.3);
  ClosedSurface surface = closeSurface(soup, options.scale, job);
  job.report(Phase::kImport, 0.6);
  makeBoundary(surface, job);
  job.report(Phase::kImport, 0.9);
  MeshBody::Data data;
  if (surface.groups.empty() ||
      std::equal(surface.groups.begin() + 1, surface.groups.end(), surface.groups.begin()))
    nameBySharpEdges(surface, data);
  else
    nameByGroups(surface, soup.groupNames, data);
  data.positions = std::move(surface.positions);
  data.triangles = std::move(surface.triangles);
  MeshBody body(std::move(data));
  job.report(Phase::kImport, 1.0);
  return body;
}

}  // namespace

MeshBody parseMesh(std::string_view bytes, FileFormat format, const std::string& sourceName,
                   const MeshReadOptions& options, const Job& job) {
  try {
    return bodyFrom(bytes, format, options, job);
  } catch (const ModelingError& error) {
    throw ModelingError(sourceName + ": " + error.what(), error.kind());
  }
}

MeshBody readMeshFile(const std::filesystem::path& path, const MeshReadOptions& options,
                      const Job& job) {
  const FileFormat format = requireFormat(path, isReadableMesh);
  return parseMesh(readTextFile(path, kMaxMeshFile), format, path.string(), options, job);
}

}  // namespace palpa::modeling

#include "modeling/exchange/mesh_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
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
    case FileFormat::kPage:
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
                            std::to_string(kMaxMeshFaces) + " can become faces: unite some of them",
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

/// The closed surfaces of a file and the names of their groups.
struct ReadSurface {
  ClosedSurface surface;
  std::vector<std::string> groupNames;
};

ReadSurface surfaceFrom(std::string_view bytes, FileFormat format, double scale, const Job& job) {
  if (!std::isfinite(scale) || scale <= 0.0)
    throw ModelingError("the scale " + numberText(scale) + " must be finite and greater than 0");
  if (bytes.size() > kMaxMeshFile)
    throw ModelingError("has " + std::to_string(bytes.size()) + " bytes; at most " +
                            std::to_string(kMaxMeshFile) +
                            " are read: reduce the number of triangles",
                        ModelingError::Kind::kTooLarge);
  job.report(Phase::kImport, 0.0);
  // The first 80 bytes of a binary STL file are arbitrary.
  PolygonSoup soup = parseSoup(format == FileFormat::kStl ? bytes : plainText(bytes), format, job);
  job.report(Phase::kImport, 0.3);
  ReadSurface read{closeSurface(soup, scale, job), std::move(soup.groupNames)};
  job.report(Phase::kImport, 0.6);
  makeBoundary(read.surface, job);
  job.report(Phase::kImport, 0.9);
  return read;
}

bool isOneGroup(const std::vector<int>& groups) {
  return groups.empty() || std::equal(groups.begin() + 1, groups.end(), groups.begin());
}

/// The bodies, named after the group that contains all their triangles.
FileBodies describe(const ReadSurface& read, ListedSurface listed) {
  const ClosedSurface& surface = read.surface;
  const auto bodyOf = [&](std::size_t t) { return surface.bodies.empty() ? 0 : surface.bodies[t]; };
  std::size_t count = 1;
  for (const int body : surface.bodies) count = std::max(count, static_cast<std::size_t>(body) + 1);
  constexpr int kNoGroup = -1;
  constexpr int kSeveralGroups = -2;
  std::vector<int> groupOf(count, kNoGroup);
  FileBodies found;
  found.bodies.resize(count);
  for (FileBody& body : found.bodies) {
    body.low.setConstant(std::numeric_limits<double>::infinity());
    body.high = -body.low;
  }
  const bool isCoarse = listed == ListedSurface::kCoarse;
  std::vector<int> number(isCoarse ? surface.positions.size() : 0, -1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    FileBody& body = found.bodies[bodyOf(t)];
    ++body.triangles;
    std::array<int, 3> corners = surface.triangles[t];
    const auto& [a, b, c] = corners;
    const auto& p = surface.positions;
    body.volume += p[a].dot(p[b].cross(p[c])) / 6.0;
    for (int& corner : corners) {
      body.low = body.low.cwiseMin(p[corner]);
      body.high = body.high.cwiseMax(p[corner]);
      if (!isCoarse) continue;
      if (number[corner] < 0) {
        number[corner] = static_cast<int>(body.positions.size());
        body.positions.push_back(p[corner]);
      }
      corner = number[corner];
    }
    if (isCoarse) body.surface.push_back(corners);
    if (surface.groups.empty()) continue;
    int& group = groupOf[bodyOf(t)];
    if (group == kNoGroup) group = surface.groups[t];
    if (group != surface.groups[t]) group = kSeveralGroups;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (groupOf[i] >= 0) found.bodies[i].name = faceName(read.groupNames[groupOf[i]]);
  makeNamesUnique(found.bodies);
  return found;
}

MeshBody bodyFrom(ClosedSurface surface, const std::vector<std::string>& groupNames) {
  MeshBody::Data data;
  if (isOneGroup(surface.groups))
    nameBySharpEdges(surface, data);
  else
    nameByGroups(surface, groupNames, data);
  data.positions = std::move(surface.positions);
  data.triangles = std::move(surface.triangles);
  return MeshBody(std::move(data));
}

ChosenMesh chosenFrom(std::string_view bytes, FileFormat format, const MeshReadOptions& options,
                      const Job& job) {
  ReadSurface read = surfaceFrom(bytes, format, options.scale, job);
  ClosedSurface& surface = read.surface;
  FileBodies found;
  std::size_t index = 0;
  if (!surface.bodies.empty() || !options.solid.empty()) {
    found = describe(read, ListedSurface::kNone);
    place(found, 1.0, options.up);
    index = chooseBody(found, options.solid);
    keepBody(surface, static_cast<int>(index));
  }
  MeshBody body = bodyFrom(std::move(surface), read.groupNames);
  job.report(Phase::kImport, 1.0);
  return {std::move(body), std::move(found), index};
}

/// Runs `work`; errors begin with the source's name.
auto withName(const std::string& sourceName, const auto& work) {
  try {
    return work();
  } catch (const SeveralBodies& several) {
    throw SeveralBodies(sourceName + ": ", several.found());
  } catch (const ModelingError& error) {
    throw ModelingError(sourceName + ": " + error.what(), error.kind());
  }
}

}  // namespace

MeshBody parseMesh(std::string_view bytes, FileFormat format, const std::string& sourceName,
                   const MeshReadOptions& options, const Job& job) {
  return withName(sourceName, [&] { return chosenFrom(bytes, format, options, job); }).body;
}

MeshBody readMeshFile(const std::filesystem::path& path, const MeshReadOptions& options,
                      const Job& job) {
  return chooseMesh(path, options, job).body;
}

ChosenMesh chooseMesh(const std::filesystem::path& path, const MeshReadOptions& options,
                      const Job& job) {
  const FileFormat format = requireFormat(path, isReadableMesh);
  const std::string bytes = readTextFile(path, kMaxMeshFile);
  return withName(path.string(), [&] { return chosenFrom(bytes, format, options, job); });
}

void readMeshBodies(const std::filesystem::path& path, const MeshReadOptions& options,
                    const TakeMesh& take, const Job& job) {
  const FileFormat format = requireFormat(path, isReadableMesh);
  const std::string bytes = readTextFile(path, kMaxMeshFile);
  const ReadSurface read =
      withName(path.string(), [&] { return surfaceFrom(bytes, format, options.scale, job); });
  const FileBodies found = describe(read, ListedSurface::kNone);
  for (std::size_t i = 0; i < found.bodies.size(); ++i) {
    job.throwIfCancelled();
    std::optional<ChosenMesh> chosen;
    std::string problem;
    try {
      ClosedSurface surface = read.surface;
      keepBody(surface, static_cast<int>(i));
      chosen.emplace(ChosenMesh{bodyFrom(std::move(surface), read.groupNames), found, i});
    } catch (const ModelingError& error) {
      problem = path.string() + ": " + error.what();
    }
    take(i, std::move(chosen), problem);
  }
}

FileBodies listMeshFile(const std::filesystem::path& path, double scale, ListedSurface surface,
                        const Job& job) {
  const FileFormat format = requireFormat(path, isReadableMesh);
  const std::string bytes = readTextFile(path, kMaxMeshFile);
  return withName(path.string(),
                  [&] { return describe(surfaceFrom(bytes, format, scale, job), surface); });
}

}  // namespace palpa::modeling

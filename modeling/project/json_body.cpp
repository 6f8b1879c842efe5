#include <unordered_map>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/json_values.h"

// Bodies as JSON: solids with their smooth edges, mesh bodies with the runs of their faces.
namespace palpa::modeling {

using nlohmann::json;

std::string sideKey(Side side) {
  std::string key(sideName(side));
  key[key.find('-')] = '_';
  return key;
}

Side sideFrom(const json& value) {
  for (Side side : {Side::kVMin, Side::kUMax, Side::kVMax})
    if (value == sideKey(side)) return side;
  return Side::kUMin;
}

namespace {

std::vector<PatchEdge> smoothEdgesFrom(const json& list, const std::vector<Patch>& patches) {
  std::unordered_map<std::string, int> patchOfName;
  for (std::size_t i = 0; i < patches.size(); ++i)
    patchOfName.emplace(patches[i].name, static_cast<int>(i));
  std::vector<PatchEdge> edges;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string name = list[i]["patch"];
    const auto found = patchOfName.find(name);
    if (found == patchOfName.end())
      throw ModelingError(joinPath("solid.smooth_edges", i) + ".patch: no patch is named \"" +
                          name + "\"");
    edges.push_back({found->second, sideFrom(list[i]["side"])});
  }
  return edges;
}

std::string patchText(const Patch& patch) {
  std::vector<std::string> rows;
  for (const auto& row : patch.net)
    rows.push_back(listText(row, [](int index) { return std::to_string(index); }));
  return "{\n        \"name\": " + quoted(patch.name) + ",\n        \"degree\": [" +
         std::to_string(patch.degree[0]) + ", " + std::to_string(patch.degree[1]) +
         "],\n        \"knots\": [\n          " + listText(patch.knots[0], numberText) +
         ",\n          " + listText(patch.knots[1], numberText) +
         "\n        ],\n        \"net\": " + linesText(rows, "        ") + "\n      }";
}

std::vector<std::string> pointLines(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::string> lines;
  lines.reserve(points.size());
  for (const Eigen::Vector3d& point : points) lines.push_back(vectorText(point));
  return lines;
}

std::vector<Eigen::Vector3d> pointsFrom(const json& list) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(list.size());
  for (const json& point : list) points.push_back(vectorFrom(point));
  return points;
}

/// Fills faceOfTriangle[first … first + count) for each run [first, count] of a face.
void readRuns(const json& runs, int face, const std::string& path, std::vector<int>& faces) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto first = runs[r][0].get<std::size_t>();
    const auto count = runs[r][1].get<std::size_t>();
    const auto fail = [&](const std::string& what) {
      throw ModelingError(joinPath(path, r) + ": " + what);
    };
    if (first + count > faces.size())
      fail("ends behind the last of the " + std::to_string(faces.size()) + " triangles");
    for (std::size_t t = first; t < first + count; ++t) {
      if (faces[t] >= 0) fail("the triangle " + std::to_string(t) + " already has a face");
      faces[t] = face;
    }
  }
}

/// The runs of equal numbers in faceOfTriangle, as text per face: the opposite of readRuns().
std::vector<std::vector<std::string>> runTexts(const MeshBody& body) {
  std::vector<std::vector<std::string>> runs(body.faceNames().size());
  const std::vector<int>& faces = body.faceOfTriangle();
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t end = first + 1;
    while (end < faces.size() && faces[end] == faces[first]) ++end;
    runs[faces[first]].push_back("[" + std::to_string(first) + ", " + std::to_string(end - first) +
                                 "]");
    first = end;
  }
  return runs;
}

}  // namespace

Solid solidFrom(const json& value) {
  std::vector<Patch> patches;
  for (const json& patch : value["patches"])
    patches.push_back({patch["name"], patch["degree"], patch["knots"], patch["net"]});
  std::vector<PatchEdge> smooth;
  if (value.contains("smooth_edges")) smooth = smoothEdgesFrom(value["smooth_edges"], patches);
  return Solid(pointsFrom(value["control_points_mm"]), std::move(patches), smooth);
}

std::string solidText(const Solid& solid) {
  std::vector<std::string> patches;
  for (const Patch& patch : solid.patches()) patches.push_back(patchText(patch));
  std::string text =
      "{\n    \"control_points_mm\": " + linesText(pointLines(solid.controlPoints()), "    ") +
      ",\n    \"patches\": " + linesText(patches, "    ");
  std::vector<std::string> smooth;
  for (const SolidEdge& edge : solid.edges())
    if (edge.smooth)
      smooth.push_back("{\"patch\": " + quoted(solid.patches()[edge.uses[0].patch].name) +
                       ", \"side\": \"" + sideKey(edge.uses[0].side) + "\"}");
  if (!smooth.empty()) text += ",\n    \"smooth_edges\": " + linesText(smooth, "    ");
  return text + "\n  }";
}

MeshBody meshBodyFrom(const json& value) {
  MeshBody::Data data;
  data.positions = pointsFrom(value["vertices_mm"]);
  for (const json& triangle : value["triangles"])
    data.triangles.push_back(triangle.get<std::array<int, 3>>());
  data.faceOfTriangle.assign(data.triangles.size(), -1);
  const json& faces = value["faces"];
  for (std::size_t f = 0; f < faces.size(); ++f) {
    data.faceNames.push_back(faces[f]["name"]);
    readRuns(faces[f]["triangles"], static_cast<int>(f),
             joinPath("mesh_body.faces", f) + ".triangles", data.faceOfTriangle);
  }
  for (std::size_t t = 0; t < data.faceOfTriangle.size(); ++t)
    if (data.faceOfTriangle[t] < 0)
      throw ModelingError("mesh_body.faces: no face has the triangle " + std::to_string(t));
  return MeshBody(std::move(data));
}

std::string meshBodyText(const MeshBody& body) {
  std::vector<std::string> triangles;
  triangles.reserve(body.triangles().size());
  for (const auto& [a, b, c] : body.triangles())
    triangles.push_back("[" + std::to_string(a) + ", " + std::to_string(b) + ", " +
                        std::to_string(c) + "]");
  const std::vector<std::vector<std::string>> runs = runTexts(body);
  std::vector<std::string> faces;
  for (std::size_t f = 0; f < runs.size(); ++f)
    faces.push_back("{\"name\": " + quoted(body.faceNames()[f]) + ", \"triangles\": " +
                    listText(runs[f], [](const std::string& run) { return run; }) + "}");
  return "{\n    \"vertices_mm\": " + linesText(pointLines(body.positions()), "    ") +
         ",\n    \"triangles\": " + linesText(triangles, "    ") +
         ",\n    \"faces\": " + linesText(faces, "    ") + "\n  }";
}

}  // namespace palpa::modeling

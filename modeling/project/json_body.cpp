#include <unordered_map>

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

Json jsonOf(const Patch& patch) {
  return {
      {"name", patch.name}, {"degree", patch.degree}, {"knots", patch.knots}, {"net", patch.net}};
}

std::vector<Eigen::Vector3d> pointsFrom(const json& list) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(list.size());
  for (const json& point : list) points.push_back(vectorFrom(point));
  return points;
}

/// Sets faceOfTriangle[first … first + count) for each run [first, count] of a face.
void readRuns(const json& runs, int face, const std::string& path, std::vector<int>& faces) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto first = runs[r][0].get<std::size_t>();
    const auto count = runs[r][1].get<std::size_t>();
    const auto fail = [&](const std::string& what) {
      throw ModelingError(joinPath(path, r) + ": " + what);
    };
    if (first + count > faces.size())
      fail("ends after the last of the " + std::to_string(faces.size()) + " triangles");
    for (std::size_t t = first; t < first + count; ++t) {
      if (faces[t] >= 0) fail("the triangle " + std::to_string(t) + " already has a face");
      faces[t] = face;
    }
  }
}

/// Per face the runs [first, count] of equal numbers in faceOfTriangle: the inverse of readRuns().
std::vector<Json> runsOf(const MeshBody& body) {
  std::vector<Json> runs(body.faceNames().size(), Json::array());
  const std::vector<int>& faces = body.faceOfTriangle();
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t end = first + 1;
    while (end < faces.size() && faces[end] == faces[first]) ++end;
    runs[faces[first]].push_back(Json{first, end - first});
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

Json jsonOf(const Solid& solid) {
  Json patches = Json::array();
  for (const Patch& patch : solid.patches()) patches.push_back(jsonOf(patch));
  Json object{{"control_points_mm", jsonOfEach(solid.controlPoints())},
              {"patches", std::move(patches)}};
  for (const SolidEdge& edge : solid.edges())
    if (edge.smooth)
      object["smooth_edges"].push_back(Json{{"patch", solid.patches()[edge.uses[0].patch].name},
                                            {"side", sideKey(edge.uses[0].side)}});
  return object;
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

Json jsonOf(const MeshBody& body) {
  std::vector<Json> runs = runsOf(body);
  Json faces = Json::array();
  for (std::size_t f = 0; f < runs.size(); ++f)
    faces.push_back(Json{{"name", body.faceNames()[f]}, {"triangles", std::move(runs[f])}});
  return {{"vertices_mm", jsonOfEach(body.positions())},
          {"triangles", body.triangles()},
          {"faces", std::move(faces)}};
}

}  // namespace palpa::modeling

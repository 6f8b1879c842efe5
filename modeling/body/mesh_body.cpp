#include "modeling/body/mesh_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {
namespace {

using Data = MeshBody::Data;

std::string pointText(const Eigen::Vector3d& p) {
  return "(" + numberText(p.x()) + ", " + numberText(p.y()) + ", " + numberText(p.z()) + ") mm";
}

std::string indexed(const char* list, std::size_t i) {
  return std::string("mesh_body.") + list + "[" + std::to_string(i) + "]";
}

void checkLists(const Data& data) {
  constexpr double kMaxCoordinate = 1e7;  // mm, as for control points
  for (std::size_t i = 0; i < data.positions.size(); ++i)
    if (!data.positions[i].allFinite() || data.positions[i].cwiseAbs().maxCoeff() > kMaxCoordinate)
      throw ModelingError(indexed("vertices_mm", i) + ": is not finite within ±" +
                          numberText(kMaxCoordinate) + " mm");
  if (data.triangles.empty()) throw ModelingError("mesh_body.triangles: is empty");
  const auto count = static_cast<int>(data.positions.size());
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const auto [a, b, c] = data.triangles[t];
    if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= count)
      throw ModelingError(indexed("triangles", t) + ": an index is out of range; there are " +
                          std::to_string(count) + " vertices");
    if (a == b || b == c || c == a)
      throw ModelingError(indexed("triangles", t) + ": uses a vertex twice");
  }
  std::set<std::string> names;
  for (std::size_t f = 0; f < data.faceNames.size(); ++f) {
    if (data.faceNames[f].empty()) throw ModelingError(indexed("faces", f) + ".name: is empty");
    if (!names.insert(data.faceNames[f]).second)
      throw ModelingError(indexed("faces", f) + ".name: \"" + data.faceNames[f] +
                          "\" is already the name of a face");
  }
  std::vector<bool> used(data.faceNames.size(), false);
  if (data.faceOfTriangle.size() != data.triangles.size())
    throw ModelingError("mesh_body.faces: must cover every triangle once");
  for (int face : data.faceOfTriangle) {
    if (face < 0 || face >= static_cast<int>(used.size()))
      throw ModelingError("mesh_body.faces: a triangle belongs to no face");
    used[face] = true;
  }
  for (std::size_t f = 0; f < used.size(); ++f)
    if (!used[f]) throw ModelingError(indexed("faces", f) + ": has no triangle");
}

/// Throws ModelingError unless every directed edge and its opposite occur exactly once.
void checkEdges(const Data& data) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(3 * data.triangles.size());
  for (const auto& n : data.triangles)
    for (int k = 0; k < 3; ++k) edges.push_back({n[k], n[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  const auto name = [&](const std::array<int, 2>& edge) {
    return "mesh_body: the edge between the vertices " + std::to_string(edge[0]) + " and " +
           std::to_string(edge[1]) + " near " + pointText(data.positions[edge[0]]);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i] == edges[i - 1])
      throw ModelingError(name(edges[i]) +
                          " is used twice in one direction: more than two triangles meet there, or "
                          "their orientations differ");
    if (!std::binary_search(edges.begin(), edges.end(), std::array{edges[i][1], edges[i][0]}))
      throw ModelingError(name(edges[i]) +
                          " has one triangle only; the surface is open there, and a body must be "
                          "closed");
  }
}

/// Throws ModelingError unless the triangles around each vertex form one fan.
void checkFans(const Data& data) {
  std::map<std::array<int, 2>, int> next;  // (vertex, second corner) -> third corner
  std::vector<int> valence(data.positions.size(), 0);
  std::vector<int> start(data.positions.size(), -1);
  for (const auto& n : data.triangles)
    for (int k = 0; k < 3; ++k) {
      next[{n[k], n[(k + 1) % 3]}] = n[(k + 2) % 3];
      ++valence[n[k]];
      start[n[k]] = n[(k + 1) % 3];
    }
  for (std::size_t v = 0; v < start.size(); ++v) {
    const int vertex = static_cast<int>(v);
    if (start[v] < 0) throw ModelingError(indexed("vertices_mm", v) + ": belongs to no triangle");
    int turned = 1;
    for (int at = next.at({vertex, start[v]}); at != start[v]; at = next.at({vertex, at})) ++turned;
    if (turned != valence[v])
      throw ModelingError(indexed("vertices_mm", v) + " at " + pointText(data.positions[v]) +
                          ": two parts of the surface touch in this vertex");
  }
}

}  // namespace

MeshBody::MeshBody(Data data) : data_(std::make_shared<const Data>(std::move(data))) {
  checkLists(*data_);
  checkEdges(*data_);
  checkFans(*data_);
  const double enclosed = volume(*this);
  if (!(enclosed > 0.0))
    throw ModelingError("mesh_body: the enclosed volume is " + numberText(enclosed) +
                        " mm³; the triangles must be counter-clockwise seen from outside");
}

std::optional<int> MeshBody::findFace(std::string_view name) const {
  const auto& names = data_->faceNames;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<int>(found - names.begin());
}

double volume(const MeshBody& body) {
  const auto& p = body.positions();
  const Eigen::Vector3d origin = p.front();  // near the surface, so that little cancels
  double sum = 0.0;
  for (const auto& [a, b, c] : body.triangles())
    sum += (p[a] - origin).dot((p[b] - origin).cross(p[c] - origin));
  return sum / 6.0;
}

double area(const MeshBody& body) {
  const auto& p = body.positions();
  double sum = 0.0;
  for (const auto& [a, b, c] : body.triangles()) sum += (p[b] - p[a]).cross(p[c] - p[a]).norm();
  return 0.5 * sum;
}

}  // namespace palpa::modeling

#include "modeling/project/body_facets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "modeling/body/smooth_regions.h"
#include "modeling/solid/tessellation.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kPiecesPerSpan = 6;
constexpr double kTipLength = 1e-6;  // of the size

const double kSharpCosine = std::cos(kSharpEdgeDegrees * std::numbers::pi / 180.0);

bool isSharp(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) < kSharpCosine * a.norm() * b.norm();
}

/// Adds the triangles that have an area.
void addFacets(const std::vector<Vector3d>& positions, const Triangles& triangles,
               const std::vector<int>& patches, BodyFacets& result) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    BodyFacets::Facet facet;
    for (int k = 0; k < 3; ++k) facet.corners[k] = positions[triangles[t][k]];
    const auto& [a, b, c] = facet.corners;
    facet.patch = patches[t];
    facet.areaNormal = 0.5 * (b - a).cross(c - a);
    if (facet.areaNormal.norm() > 0.0) result.facets.push_back(facet);
  }
}

void addTip(const Vector3d& position, BodyFacets& result) {
  result.sharpEdges.push_back({position, position + kTipLength * result.size * Vector3d::UnitX()});
}

void addSolid(const Solid& solid, BodyFacets& result) {
  const Tessellation tessellation(solid, kPiecesPerSpan);
  const Tessellation::Shape shape = tessellation.evaluate(solid.controlPoints());
  addFacets(shape.positions, tessellation.triangles(), tessellation.patchOfTriangle(), result);
  for (std::size_t i = 0; i < shape.normals.size(); ++i)
    if (shape.normals[i].isZero()) addTip(shape.positions[i], result);
  const auto border = [&](const PatchEdge& edge) -> const std::vector<int>& {
    return tessellation
        .borders()[static_cast<std::size_t>(4 * edge.patch) + static_cast<std::size_t>(edge.side)];
  };
  for (const SolidEdge& edge : solid.edges()) {
    const auto& [first, second] = edge.uses;
    result.neighbours.push_back({first.patch, second.patch});
    const std::vector<int>& line = border(first);
    std::vector<int> other = border(second);
    if (edge.reversed) std::reverse(other.begin(), other.end());
    for (std::size_t i = 0; i + 1 < std::min(line.size(), other.size()); ++i)
      if (isSharp(shape.normals[line[i]], shape.normals[other[i]]) ||
          isSharp(shape.normals[line[i + 1]], shape.normals[other[i + 1]]))
        result.sharpEdges.push_back({shape.positions[line[i]], shape.positions[line[i + 1]]});
  }
}

/// Vertices whose triangles look in all directions: tips of cones, whose edges are not sharp.
void addTips(const MeshBody& body, const std::vector<int>& reliable,
             const std::vector<Vector3d>& normals, BodyFacets& result) {
  std::vector<Vector3d> sum(body.positions().size(), Vector3d::Zero());
  const Triangles& triangles = body.triangles();
  const auto unit = [&](std::size_t t) { return normals[reliable[t]].normalized(); };
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int vertex : triangles[t]) sum[vertex] += unit(t);
  std::vector<bool> isTip(sum.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int vertex : triangles[t])
      if (isSharp(sum[vertex], unit(t))) isTip[vertex] = true;
  for (std::size_t v = 0; v < isTip.size(); ++v)
    if (isTip[v]) addTip(body.positions()[v], result);
}

void addMeshBody(const MeshBody& body, BodyFacets& result) {
  const Triangles& triangles = body.triangles();
  const std::vector<Vector3d>& positions = body.positions();
  addFacets(positions, triangles, body.faceOfTriangle(), result);
  const auto neighbours = triangleNeighbours(triangles);
  const std::vector<int> reliable = reliableTriangles(positions, triangles, neighbours);
  std::vector<Vector3d> normals;
  for (const auto& [a, b, c] : triangles)
    normals.push_back((positions[b] - positions[a]).cross(positions[c] - positions[a]));
  std::set<std::array<int, 2>> pairs;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto other = static_cast<std::size_t>(neighbours[t][k]);
      if (other < t) continue;
      const int face = body.faceOfTriangle()[t], otherFace = body.faceOfTriangle()[other];
      if (face != otherFace) pairs.insert({std::min(face, otherFace), std::max(face, otherFace)});
      if (isSharp(normals[reliable[t]], normals[reliable[other]]))
        result.sharpEdges.push_back(
            {positions[triangles[t][k]], positions[triangles[t][(k + 1) % 3]]});
    }
  }
  result.neighbours.assign(pairs.begin(), pairs.end());
  addTips(body, reliable, normals, result);
}

}  // namespace

BodyFacets bodyFacets(const Body& body) {
  BodyFacets result;
  const auto [low, high] = boundingBox(body);
  result.size = (high - low).norm();
  if (const auto* solid = std::get_if<Solid>(&body))
    addSolid(*solid, result);
  else
    addMeshBody(std::get<MeshBody>(body), result);
  return result;
}

}  // namespace palpa::modeling

#include "bem/model/boundary_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>

#include "bem/base/error.h"

namespace palpa::bem {
namespace {

using Eigen::Vector3d;

[[noreturn]] void badMesh(const std::string& message) {
  throw SolverError(SolverError::Kind::kBadMesh, message);
}

void checkSizesAndNumbers(const BoundaryMesh& mesh) {
  const auto triangles = mesh.triangles.size();
  if (mesh.smoothingGroups.size() != triangles || mesh.tags.size() != triangles)
    badMesh("boundary mesh: smoothing groups and tags must have one entry per triangle");
  for (int k = 0; k < mesh.nodeCount(); ++k)
    if (!mesh.nodes[k].allFinite())
      badMesh("boundary mesh: node " + std::to_string(k) + " has a coordinate that is not finite");
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int node : mesh.triangles[t])
      if (node < 0 || node >= mesh.nodeCount())
        badMesh("boundary mesh: triangle " + std::to_string(t) + " names node " +
                std::to_string(node) + ", but there are " + std::to_string(mesh.nodeCount()));
}

void checkClosed(const BoundaryMesh& mesh) {
  std::unordered_map<long long, int> uses;
  const long long stride = mesh.nodeCount();
  uses.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[t[k] * stride + t[(k + 1) % 3]];
  for (const auto& [edge, count] : uses) {
    const long long from = edge / stride, to = edge % stride;
    if (count != 1 || !uses.contains(to * stride + from))
      badMesh("boundary mesh: the surface is open or not a manifold at the edge from node " +
              std::to_string(from) + " to node " + std::to_string(to));
  }
}

/// Interior angle of a triangle at one of its corners, radians.
double cornerAngle(const BoundaryMesh& mesh, int triangle, int corner) {
  const auto& t = mesh.triangles[triangle];
  const Vector3d a = mesh.nodes[t[(corner + 1) % 3]] - mesh.nodes[t[corner]];
  const Vector3d b = mesh.nodes[t[(corner + 2) % 3]] - mesh.nodes[t[corner]];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

Vector3d BoundaryMesh::areaVector(int triangle) const {
  const auto& t = triangles[triangle];
  return 0.5 * (nodes[t[1]] - nodes[t[0]]).cross(nodes[t[2]] - nodes[t[0]]);
}

Vector3d BoundaryMesh::point(int triangle, const Vector3d& weights) const {
  const auto& t = triangles[triangle];
  return weights[0] * nodes[t[0]] + weights[1] * nodes[t[1]] + weights[2] * nodes[t[2]];
}

double BoundaryMesh::surfaceArea() const {
  double sum = 0;
  for (int t = 0; t < triangleCount(); ++t) sum += area(t);
  return sum;
}

double BoundaryMesh::volume() const {
  double sum = 0;
  for (int t = 0; t < triangleCount(); ++t)
    sum += areaVector(t).dot(nodes[triangles[t][0]] - nodes[0]) / 3.0;
  return sum;
}

double BoundaryMesh::boundingSize() const {
  Vector3d low = nodes.front(), high = nodes.front();
  for (const auto& p : nodes) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

double BoundaryMesh::meanEdgeLength() const {
  double sum = 0;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) sum += (nodes[t[(k + 1) % 3]] - nodes[t[k]]).norm();
  return sum / (3.0 * static_cast<double>(triangles.size()));
}

void BoundaryMesh::validate() const {
  if (triangles.empty()) badMesh("boundary mesh: there are no triangles");
  checkSizesAndNumbers(*this);
  for (int t = 0; t < triangleCount(); ++t) {
    const auto& c = triangles[t];
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (nodes[c[(k + 1) % 3]] - nodes[c[k]]).squaredNorm());
    if (!(area(t) > 1e-9 * longest))
      badMesh("boundary mesh: triangle " + std::to_string(t) + " has no area");
  }
  checkClosed(*this);
  if (!(volume() > 0))
    badMesh("boundary mesh: the enclosed volume is not positive; the surface is inside out");
}

TractionSlots::TractionSlots(const BoundaryMesh& mesh) {
  std::map<std::tuple<int, int, int>, int> index;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int node : mesh.triangles[t])
      index[{node, mesh.smoothingGroups[t], mesh.tags[t]}] = 0;
  firstOfNode.assign(mesh.nodeCount() + 1, 0);
  for (auto& [key, slot] : index) {
    const auto& [node, group, tag] = key;
    slot = count();
    slots.push_back({node, group, tag, Vector3d::Zero()});
    ++firstOfNode[node + 1];
  }
  for (int k = 0; k < mesh.nodeCount(); ++k) firstOfNode[k + 1] += firstOfNode[k];

  ofCorner.resize(mesh.triangles.size());
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const int slot = index[{mesh.triangles[t][corner], mesh.smoothingGroups[t], mesh.tags[t]}];
      ofCorner[t][corner] = slot;
      slots[slot].normal += cornerAngle(mesh, t, corner) * mesh.normal(t);
    }
  for (auto& slot : slots) slot.normal.normalize();
}

double nodalArea(const BoundaryMesh& mesh, int node) {
  double sum = 0;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    for (const int corner : mesh.triangles[t])
      if (corner == node) sum += mesh.area(t) / 3.0;
  return sum;
}

}  // namespace palpa::bem

#include "modeling/mesh/support_chords.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "base/support_border.h"

namespace palpa::modeling {
namespace {

/// Replaces a triangle (…, from, to, …) by its half at `from`, and appends the half at `to`.
void halve(SurfaceMesh& mesh, std::vector<bool>& isSupported, int triangle, int from, int to,
           int middle) {
  std::array<int, 3> second = mesh.triangles[triangle];
  std::replace(second.begin(), second.end(), from, middle);
  std::array<int, 3>& first = mesh.triangles[triangle];
  std::replace(first.begin(), first.end(), to, middle);
  const int added = static_cast<int>(mesh.triangles.size());
  mesh.triangles.push_back(second);
  const auto copyTo = [triangle](auto& values) { values.push_back(values[triangle]); };
  copyTo(mesh.patchOfTriangle);
  copyTo(mesh.smoothingGroupOfTriangle);
  copyTo(mesh.bordersOfTriangle);
  copyTo(isSupported);
  for (std::vector<int>& region : mesh.trianglesOfRegion)
    if (std::binary_search(region.begin(), region.end(), triangle)) region.push_back(added);
}

/// True if a node at `at` divides both triangles of an edge into halves that point as they do and
/// are not much smaller.
bool dividesTriangles(const SurfaceMesh& mesh, const ElementEdge& edge, const Eigen::Vector3d& at) {
  constexpr double kLeast = 0.1;  // a half at the middle of a straight edge has 0.5
  const auto areaOf = [&](const std::array<int, 3>& nodes, int replaced) {
    const auto position = [&](int node) { return node == replaced ? at : mesh.positions[node]; };
    const Eigen::Vector3d a = position(nodes[0]), b = position(nodes[1]), c = position(nodes[2]);
    return Eigen::Vector3d((b - a).cross(c - a));
  };
  constexpr int kNone = -1;
  for (const int t : {edge.left, edge.right}) {
    const Eigen::Vector3d whole = areaOf(mesh.triangles[t], kNone);
    for (const int replaced : {edge.from, edge.to})
      if (areaOf(mesh.triangles[t], replaced).dot(whole) < kLeast * whole.squaredNorm())
        return false;
  }
  return true;
}

/// Where a chord is split: on the true surface, or on the chord itself if that point would fold its
/// triangles. The chord of a rounded border passes over the surface beyond it, and the nearest
/// point of that may lie on the border. Nodes of a solid keep the place of their parameters.
MiddleNode middleOfChord(const SurfaceMesh& mesh, const ElementEdge& edge,
                         const MiddleNodes& middles) {
  MiddleNode middle = middles.of(edge);
  if (mesh.parameters.empty() && !dividesTriangles(mesh, edge, middle.position))
    middle.position = (mesh.positions[edge.from] + mesh.positions[edge.to]) / 2;
  return middle;
}

/// Splits chords of which no two belong to one triangle; returns whether there were any.
bool splitSome(SurfaceMesh& mesh, std::vector<bool>& isSupported, const MiddleNodes& middles) {
  std::vector<bool> isOnBorder(mesh.positions.size(), false), isOnNotch = isOnBorder;
  std::map<int, std::set<int>> alongBorder;  // neighbours of its vertices
  const auto isBorder = supportBorderEdges(mesh.triangles, isSupported);
  const auto isNotch =
      notchEdges(mesh.triangles, mesh.positions, mesh.smoothingGroupOfTriangle, isSupported);
  for (std::size_t t = 0; t < isBorder.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (isBorder[t][k] || isNotch[t][k]) {
        const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        isOnBorder[a] = isOnBorder[b] = true;
        if (isNotch[t][k]) isOnNotch[a] = isOnNotch[b] = true;
        alongBorder[a].insert(b);
        alongBorder[b].insert(a);
      }
  // Only those that cut off one vertex of the border: on a narrow support all edges across it join
  // vertices of its border, and halves would double the number of triangles.
  const auto isChord = [&](int a, int b) {
    if (!isOnBorder[a] || !isOnBorder[b]) return false;
    const std::set<int>&ofA = alongBorder.at(a), &ofB = alongBorder.at(b);
    if (ofA.contains(b)) return false;
    return isOnNotch[a] || isOnNotch[b] ||
           std::any_of(ofA.begin(), ofA.end(), [&](int v) { return ofB.contains(v); });
  };
  // Bodies that nothing holds have none; this scan is shorter than the map of all edges.
  if (std::none_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
        return isChord(t[0], t[1]) || isChord(t[1], t[2]) || isChord(t[2], t[0]);
      }))
    return false;
  std::set<int> touched;
  for (const auto& [nodes, edge] : elementEdges(mesh, isOnBorder)) {
    if (!isChord(edge.from, edge.to)) continue;
    if (touched.contains(edge.left) || touched.contains(edge.right)) continue;
    touched.insert({edge.left, edge.right});
    const MiddleNode middle = middleOfChord(mesh, edge, middles);
    const int node = static_cast<int>(mesh.positions.size());
    mesh.positions.push_back(middle.position);
    if (!mesh.parameters.empty()) mesh.parameters.push_back(middle.parameter);
    halve(mesh, isSupported, edge.left, edge.from, edge.to, node);
    halve(mesh, isSupported, edge.right, edge.to, edge.from, node);
  }
  return !touched.empty();
}

}  // namespace

void splitSupportChords(SurfaceMesh& mesh, std::vector<bool>& isSupported,
                        const MiddleNodes& middles) {
  while (splitSome(mesh, isSupported, middles)) {
  }
}

}  // namespace palpa::modeling

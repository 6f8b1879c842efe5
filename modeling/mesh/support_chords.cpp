#include "modeling/mesh/support_chords.h"

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

/// Splits chords of which no two belong to one triangle; returns whether there were any.
bool splitSome(SurfaceMesh& mesh, std::vector<bool>& isSupported, const MiddleNodes& middles) {
  std::vector<bool> isOnBorder(mesh.positions.size(), false);
  std::map<int, std::set<int>> alongBorder;  // neighbours of its vertices
  const auto isBorder = supportBorderEdges(mesh.triangles, isSupported);
  for (std::size_t t = 0; t < isBorder.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (isBorder[t][k]) {
        const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        isOnBorder[a] = isOnBorder[b] = true;
        alongBorder[a].insert(b);
        alongBorder[b].insert(a);
      }
  // Only those that cut off one vertex of the border: on a narrow support all edges across it join
  // vertices of its border, and halves would double the number of triangles.
  const auto isChord = [&](int a, int b) {
    if (!isOnBorder[a] || !isOnBorder[b]) return false;
    const std::set<int>&ofA = alongBorder.at(a), &ofB = alongBorder.at(b);
    return !ofA.contains(b) &&
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
    const MiddleNode middle = middles.of(edge);
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

#include "modeling/mesh/mesh_improve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "modeling/mesh/mesh_refine.h"

namespace palpa::modeling {
namespace {

/// Triangles with smaller angles may lose a node; others are only flipped and moved.
constexpr double kCollapseAngle = 24.0 * std::numbers::pi / 180.0;

constexpr int kCheckpoint = 1000;  // triangles between checks of the stop token

/// Tries the operations on one triangle; returns whether one of them changed the mesh.
bool improveOne(MeshEditor& editor, int triangle) {
  const std::array<int, 3> n = editor.mesh().triangles[triangle].nodes;
  std::array<int, 3> byLength{0, 1, 2};
  const auto length = [&](int k) {
    return (editor.position(n[k]) - editor.position(n[(k + 1) % 3])).norm();
  };
  std::stable_sort(byLength.begin(), byLength.end(),
                   [&](int a, int b) { return length(a) > length(b); });
  for (int k : byLength)
    if (editor.flip(n[k], n[(k + 1) % 3])) return true;
  if (editor.smallestAngleOf(triangle) < kCollapseAngle) {
    const int shortest = byLength[2];
    const int a = n[shortest];
    const int b = n[(shortest + 1) % 3];
    if (editor.collapse(a, b) || editor.collapse(b, a)) return true;
  }
  for (int node : n)
    if (editor.smooth(node)) return true;
  return false;
}

}  // namespace

void improveShapes(MeshEditor& editor) {
  constexpr int kRounds = 40;
  std::vector<int> candidates(editor.mesh().triangles.size());
  for (std::size_t t = 0; t < candidates.size(); ++t) candidates[t] = static_cast<int>(t);
  for (int round = 0; round < kRounds && !candidates.empty(); ++round) {
    std::vector<std::pair<double, int>> bad;
    for (int t : candidates) {
      if (t % kCheckpoint == 0) editor.checkpoint();
      if (editor.isAlive(t) && editor.penalty(t) > 0.0) bad.emplace_back(-editor.penalty(t), t);
    }
    std::sort(bad.begin(), bad.end());
    // Only triangles near a change of this round can improve in the next round.
    std::vector<int> touched;
    for (const auto& [key, t] : bad) {
      if (!editor.isAlive(t)) continue;
      const std::array<int, 3> nodes = editor.mesh().triangles[t].nodes;
      if (!improveOne(editor, t)) continue;
      for (int node : nodes)
        for (int near : editor.neighbours(node))
          touched.insert(touched.end(), editor.around(near).begin(), editor.around(near).end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    candidates = std::move(touched);
  }
}

void relieveSlivers(MeshEditor& editor) {
  constexpr double kSliver = 15.0 * std::numbers::pi / 180.0;
  constexpr int kRounds = 8;
  // The angle opposite the shortest edge is the smallest. Refinement cannot enlarge it if it lies
  // between two interfaces.
  const auto isGap = [&](const std::array<int, 3>& n) {
    std::array<double, 3> opposite{};
    for (int k = 0; k < 3; ++k)
      opposite[k] = (editor.position(n[(k + 1) % 3]) - editor.position(n[(k + 2) % 3])).norm();
    const auto k = std::min_element(opposite.begin(), opposite.end()) - opposite.begin();
    return !editor.isInterface(n[k], n[(k + 1) % 3]) || !editor.isInterface(n[k], n[(k + 2) % 3]);
  };
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<int, std::array<int, 3>>> slivers;
    for (std::size_t i = 0; i < editor.mesh().triangles.size(); ++i) {
      if (i % kCheckpoint == 0) editor.checkpoint();
      const int t = static_cast<int>(i);
      if (!editor.isAlive(t) || editor.smallestAngleOf(t) > kSliver) continue;
      if (isGap(editor.mesh().triangles[i].nodes))
        slivers.emplace_back(t, editor.mesh().triangles[i].nodes);
    }
    if (slivers.empty()) return;
    for (const auto& [t, nodes] : slivers)
      if (editor.isAlive(t) && editor.mesh().triangles[t].nodes == nodes) bisect(editor, t);
    improveShapes(editor);
  }
}

void closeWedges(MeshEditor& editor, double borderError) {
  constexpr double kWedge = 18.0 * std::numbers::pi / 180.0;
  constexpr double kMinSlope = 0.1;  // of the border's value over the surface
  constexpr double kMinPart = 0.2;   // of an edge; shorter pieces would make slivers
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < editor.mesh().triangles.size(); ++i) {
      if (i % kCheckpoint == 0) editor.checkpoint();
      const int t = static_cast<int>(i);
      if (!editor.isAlive(t) || editor.smallestAngleOf(t) > kWedge) continue;
      const WorkTriangle triangle = editor.mesh().triangles[i];
      for (int k = 0; k < 6; ++k) {
        // The tip, the next node on the patch edge and the next node on the border, in both
        // orientations.
        const int tip = triangle.nodes[k % 3];
        const int onEdge = triangle.nodes[(k + (k < 3 ? 1 : 2)) % 3];
        const int onBorder = triangle.nodes[(k + (k < 3 ? 2 : 1)) % 3];
        const auto beyond = [&](int a, int b) {
          return editor.leftOf(a, b) == t ? editor.leftOf(b, a) : editor.leftOf(a, b);
        };
        const WorkTriangle& other = editor.mesh().triangles[beyond(tip, onEdge)];
        const WorkTriangle& across = editor.mesh().triangles[beyond(tip, onBorder)];
        const WorkTriangle& third = editor.mesh().triangles[beyond(onEdge, onBorder)];
        const std::uint64_t differing = triangle.sides ^ across.sides;
        if (other.patch == triangle.patch || across.patch != triangle.patch ||
            std::popcount(differing) != 1 ||
            (third.patch == triangle.patch && third.sides != triangle.sides))
          continue;
        const bool atCorner = third.patch != triangle.patch;
        const Eigen::Vector3d toEdge = editor.position(onEdge) - editor.position(tip);
        const Eigen::Vector3d toBorder = editor.position(onBorder) - editor.position(tip);
        const double cosine = toEdge.dot(toBorder) / (toEdge.norm() * toBorder.norm());
        if (cosine < std::cos(kWedge)) continue;
        // Distances from the border within the surface.
        const RegionBorder& border = editor.borders()[std::countr_zero(differing)];
        const Eigen::Vector3d normal = toEdge.cross(toBorder).normalized();
        const Eigen::Vector3d gradient = border.gradient(editor.position(onEdge));
        const double slope = (gradient - gradient.dot(normal) * normal).norm();
        if (slope < kMinSlope * border.slope()) continue;
        const double start = std::abs(border.value(editor.position(tip))) / slope;
        const double end = std::abs(border.value(editor.position(onEdge))) / slope;
        const double part = end <= borderError ? 1.0 : (borderError - start) / (end - start);
        if (part < (atCorner ? 1.0 : kMinPart)) continue;
        int wedge = t;
        if (part < 1.0) {
          const int last = editor.split(tip, onEdge, std::min(part, 1.0 - kMinPart));
          wedge = editor.leftOf(tip, last) >= 0 &&
                          editor.mesh().triangles[editor.leftOf(tip, last)].patch == triangle.patch
                      ? editor.leftOf(tip, last)
                      : editor.leftOf(last, tip);
        }
        editor.setSides(wedge, triangle.sides ^ differing);
        changed = true;
        break;
      }
    }
    if (!changed) return;
    improveShapes(editor);
  }
}

}  // namespace palpa::modeling

#include "modeling/mesh/work_mesh.h"

#include <cassert>

namespace palpa::modeling {

const SurfaceParameter& WorkMesh::in(int node, int patch) const {
  const auto& at = nodes[node].at;
  for (const SurfaceParameter& parameter : at)
    if (parameter.patch == patch) return parameter;
  assert(false && "the node does not belong to the patch");
  return at.front();
}

int WorkMesh::edgeBetween(int a, int b) const {
  const WorkNode& first = nodes[a];
  const WorkNode& second = nodes[b];
  if (first.at.size() < 2 || second.at.size() < 2) return -1;
  if (first.edge >= 0 && second.edge >= 0) return first.edge == second.edge ? first.edge : -1;
  // One or two corners: an edge that both nodes belong to. A mesh edge that cuts off a patch's
  // corner has its ends on different edges; an edge between two corners lies on the solid's edge.
  const auto touches = [&](const WorkNode& node, int edge) {
    if (node.edge >= 0) return node.edge == edge;
    for (int end : {0, 1}) {
      const SurfaceParameter p = onEdge(*surface, solid->edges()[edge], 0, end);
      for (const SurfaceParameter& own : node.at)
        if (own.patch == p.patch && own.u == p.u && own.v == p.v) return true;
    }
    return false;
  };
  if (first.edge >= 0) return touches(second, first.edge) ? first.edge : -1;
  if (second.edge >= 0) return touches(first, second.edge) ? second.edge : -1;
  for (std::size_t edge = 0; edge < solid->edges().size(); ++edge)
    if (touches(first, static_cast<int>(edge)) && touches(second, static_cast<int>(edge)))
      return static_cast<int>(edge);
  return -1;
}

WorkNode WorkMesh::between(int a, int b, int patch, double s) const {
  const int edge = edgeBetween(a, b);
  if (edge < 0) {
    const SurfaceParameter& p = in(a, patch);
    const SurfaceParameter& q = in(b, patch);
    return nodeInPatch({patch, p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
  }
  const SolidEdge& solidEdge = solid->edges()[edge];
  const auto fraction = [&](int node) {
    if (nodes[node].edge >= 0) return nodes[node].edgeFraction;
    const SurfaceParameter start = onEdge(*surface, solidEdge, 0, 0.0);
    const SurfaceParameter& own = in(node, start.patch);
    return own.u == start.u && own.v == start.v ? 0.0 : 1.0;
  };
  return nodeOnEdge(edge, (1.0 - s) * fraction(a) + s * fraction(b));
}

WorkNode WorkMesh::nodeInPatch(const SurfaceParameter& at) const {
  WorkNode node;
  node.position = surface->position(at.patch, at.u, at.v);
  node.at = {at};
  return node;
}

WorkNode WorkMesh::nodeOnEdge(int edge, double fraction) const {
  const SolidEdge& solidEdge = solid->edges()[edge];
  WorkNode node;
  node.at = {onEdge(*surface, solidEdge, 0, fraction), onEdge(*surface, solidEdge, 1, fraction)};
  node.position = surface->position(node.at[0].patch, node.at[0].u, node.at[0].v);
  node.edge = edge;
  node.edgeFraction = fraction;
  return node;
}

WorkNode WorkMesh::nodeInCorner(int vertex) const {
  WorkNode node;
  node.position = solid->controlPoints()[vertex];
  for (std::size_t p = 0; p < solid->patches().size(); ++p)
    for (Side side : {Side::kVMin, Side::kVMax}) {
      const PatchEdge edge{static_cast<int>(p), side};
      const auto ends = solid->verticesOf(edge.patch, side);
      for (int end : {0, 1})
        if (ends[end] == vertex) node.at.push_back(onSide(*surface, edge, end));
    }
  return node;
}

}  // namespace palpa::modeling

#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/mesh/surface_mesh.h"

namespace palpa::modeling {

/// Edge of a mesh of elements with the triangles on both sides, and the borders that it lies on.
struct ElementEdge {
  int from = -1, to = -1;     ///< nodes; counter-clockwise in `left`
  int left = -1, right = -1;  ///< triangles
  double share = 0.5;         ///< of the middle node, from `from` to `to`
  std::vector<const RegionBorder*> borders;
};

/// Share of the middle node of an edge: a half, or a quarter from the border of a support if one
/// end lies on it.
double middleShare(const std::vector<bool>& isBorderVertex, int from, int to);

/// All edges by their nodes, the smaller one first. The borders belong to the mesh.
std::map<std::pair<int, int>, ElementEdge> elementEdges(const SurfaceMesh& mesh,
                                                        const std::vector<bool>& isBorderVertex);

struct MiddleNode {
  Eigen::Vector3d position;      ///< mm
  SurfaceParameter parameter{};  ///< on a solid
};

/// Places of the middle nodes of edges on the surface of a body: near their share of the edge, on
/// the edges of patches and faces and the borders of regions where their edge is.
class MiddleNodes {
 public:
  virtual ~MiddleNodes() = default;
  virtual MiddleNode of(const ElementEdge& edge) const = 0;
};

/// Mesh and body must outlive the result.
std::unique_ptr<MiddleNodes> makeMiddleNodes(const SurfaceMesh& mesh, const Body& body);

}  // namespace palpa::modeling

#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "app/core/page/touch_page.h"
#include "app/core/results/drawn_body.h"
#include "base/job.h"
#include "bem/model/surface_point.h"

namespace palpa::app {

/// The surface of a page: the nodes of the model's mesh, at which displacements are stored, and
/// drawn vertices and triangles, which may be finer and are finer at strong bends.
class PageSurface {
 public:
  /// About 10 µs per vertex. Throws Cancelled.
  PageSurface(const TouchableModel& model, const Job& job);

  std::size_t nodeCount() const { return atNodes_->mesh().positions.size(); }
  std::size_t vertexCount() const { return drawn_->mesh().positions.size(); }

  /// Sets positions, normals, triangles, edges, nodes and nodeWeights, and isTouchable to false on
  /// supports.
  void describe(TouchPage& page) const;

  /// Place of the model's surface that a touch at a drawn point has: the nearest one. Drawn
  /// vertices are on the exact surface of the body, beside the point of the model's mesh with the
  /// same barycentric coordinates.
  bem::SurfacePoint at(const TouchPage::Point& point) const;
  bem::SurfacePoint atVertex(std::size_t vertex) const;
  /// Per edge (TouchPage::edges): a triangle, and the middle of the edge in it.
  const std::vector<TouchPage::Point>& edgeMiddles() const { return edgeMiddles_; }

  /// Displacements of the nodes and of the vertices, 3 rows each, from displacement coefficients.
  Eigen::VectorXd nodeField(const Eigen::VectorXd& u) const { return fieldOf(*atNodes_, u); }
  Eigen::VectorXd vertexField(const Eigen::VectorXd& u) const { return fieldOf(*drawn_, u); }

 private:
  static Eigen::VectorXd fieldOf(const DrawnBody& body, const Eigen::VectorXd& u);
  /// Barycentric coordinates of a vertex in one of the boundary triangles around it.
  Eigen::Vector3d linkIn(const modeling::DisplayMesh& mesh, int boundaryTriangle, int vertex) const;
  void findEdges();
  void linkToNodes(TouchPage& page) const;

  const TouchableModel& model_;
  std::unique_ptr<DrawnBody> atNodes_, drawn_;
  std::vector<std::array<std::uint16_t, 3>> edges_;
  std::vector<TouchPage::Point> edgeMiddles_;
};

}  // namespace palpa::app

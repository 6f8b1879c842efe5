#pragma once

#include <utility>
#include <vector>

#include "base/job.h"
#include "modeling/body/region.h"
#include "modeling/mesh/region_border.h"
#include "modeling/mesh/work_mesh.h"

namespace palpa::modeling {

/// Editor of a closed triangle mesh over the patches of a solid by local operations: split, flip,
/// collapse, move. An edge between triangles of different patches or on different sides of a border
/// is an *interface*; operations preserve interfaces, and nodes on an interface stay on it.
class MeshEditor {
 public:
  /// `borders[k]` belongs to bit k of WorkTriangle::sides. Every operation first throws Cancelled
  /// if the job was stopped; algorithms with long computations between operations call
  /// checkpoint().
  MeshEditor(WorkMesh mesh, std::vector<RegionBorder> borders, Job job = {});

  /// Throws Cancelled if the job was stopped.
  void checkpoint() const { job_.throwIfCancelled(); }

  /// The mesh without the removed nodes and triangles. The editor is empty afterwards.
  WorkMesh take();

  const WorkMesh& mesh() const { return mesh_; }
  const std::vector<RegionBorder>& borders() const { return borders_; }
  const Eigen::Vector3d& position(int node) const { return mesh_.nodes[node].position; }
  /// Triangles around a node.
  const std::vector<int>& around(int node) const { return around_[node]; }
  bool isAlive(int triangle) const { return mesh_.triangles[triangle].patch >= 0; }
  void setSides(int triangle, std::uint64_t sides) { mesh_.triangles[triangle].sides = sides; }

  /// The triangle left of the directed edge a → b; -1 if there is none.
  int leftOf(int a, int b) const;
  bool isInterface(int a, int b) const;
  /// Neighbours of a node over interface edges, ascending.
  std::vector<int> interfaceNeighbours(int node) const;
  std::vector<int> neighbours(int node) const;

  /// A node on the true surface at the fraction s of the mesh edge a–b. It is not yet in the mesh.
  WorkNode between(int a, int b, double s) const;

  /// Splits the edge a–b and returns the new node, which lies on the border if the edge does.
  int split(int a, int b, double s = 0.5);
  int split(int a, int b, WorkNode node);

  /// The next three change the mesh only if this lowers the shape penalty of the affected
  /// triangles. They return whether they changed it.
  bool flip(int a, int b);
  bool collapse(int from, int to);
  bool smooth(int node);

  /// Moves a node if all triangles around it stay valid; returns whether it moved.
  bool move(int node, WorkNode where);

  /// Shape penalty of a triangle: 0 if all angles exceed about 35 degrees, larger for smaller
  /// angles.
  double penalty(int triangle) const;
  double smallestAngleOf(int triangle) const;

 private:
  double shapePenalty(int a, int b, int c) const;
  bool isValid(int a, int b, int c, int patch) const;
  bool starIsValid(int node) const;
  bool turnsAt(int node, int before, int after) const;
  double starPenalty(int node) const;
  bool tryPosition(int node, const WorkNode& where, double before);
  WorkNode onBorder(WorkNode node, const RegionBorder& border) const;
  WorkNode shifted(const WorkNode& node, const Eigen::Vector3d& step) const;
  void replace(int triangle, const std::array<int, 3>& nodes);

  WorkMesh mesh_;
  std::vector<RegionBorder> borders_;
  std::vector<std::vector<int>> around_;  // live triangles around each node
  Job job_;
};

}  // namespace palpa::modeling

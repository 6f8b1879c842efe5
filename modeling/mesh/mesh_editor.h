#pragma once

#include <utility>
#include <vector>

#include "base/job.h"
#include "modeling/body/region.h"
#include "modeling/mesh/region_border.h"
#include "modeling/mesh/work_mesh.h"

namespace palpa::modeling {

/// Local changes of a closed triangle mesh over the patches of a solid: split, flip, collapse,
/// move. An edge between triangles of different patches or on different sides of a border is an
/// *interface*; no operation destroys one, and nodes on it stay on it.
class MeshEditor {
 public:
  /// `borders[k]` belongs to bit k of WorkTriangle::sides. Every change looks at the job's stop
  /// token first; algorithms that compute long between changes ask checkpoint() themselves.
  MeshEditor(WorkMesh mesh, std::vector<RegionBorder> borders, Job job = {});

  /// @throws Cancelled
  void checkpoint() const { job_.throwIfCancelled(); }

  /// The mesh without the gaps that collapses leave. The editor is empty afterwards.
  WorkMesh take();

  const WorkMesh& mesh() const { return mesh_; }
  const std::vector<RegionBorder>& borders() const { return borders_; }
  const Eigen::Vector3d& position(int node) const { return mesh_.nodes[node].position; }
  const std::vector<int>& around(int node) const { return around_[node]; }
  bool isAlive(int triangle) const { return mesh_.triangles[triangle].patch >= 0; }
  void setSides(int triangle, std::uint64_t sides) { mesh_.triangles[triangle].sides = sides; }

  /// The triangle left of the directed edge a → b; -1 when there is none.
  int leftOf(int a, int b) const;
  bool isInterface(int a, int b) const;
  /// Neighbours of a node over interface edges, ascending.
  std::vector<int> interfaceNeighbours(int node) const;
  std::vector<int> neighbours(int node) const;

  /// The true surface position at the fraction s of the mesh edge a–b.
  WorkNode between(int a, int b, double s) const;

  /// Cuts the edge a–b; on a border the new node is put onto it. Returns the new node.
  int split(int a, int b, double s = 0.5);
  int split(int a, int b, WorkNode node);

  /// The three below change the mesh only if the shape penalty of the triangles concerned falls.
  bool flip(int a, int b);
  bool collapse(int from, int to);
  bool smooth(int node);

  /// Moves a node if all triangles around it stay valid.
  bool move(int node, WorkNode where);

  /// 0 for a triangle whose angles are all above about 35 degrees, growing as one gets smaller.
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

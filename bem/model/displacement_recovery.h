#pragma once

#include <map>
#include <vector>

#include "bem/model/boundary_mesh.h"

namespace palpa::bem {

/// Displacement between nodes to third order. Linear interpolation of (accurate) nodal values cuts
/// the tip off the displacement under a narrow load. Instead the gradient at a slot is the
/// area-weighted mean of the gradients of the surrounding triangles, and each edge is a cubic: in a
/// triangle
///   u = sum_a λ_a u_a + sum_{a<b} λ_a λ_b b_ab,  b_ab = (grad u_a - grad u_b)(x_b - x_a) / 2.
/// Linear in the nodal values, exact for quadratic fields on a regular flat mesh, one-sided at
/// sharp edges. (Gradient recovery after Zienkiewicz & Zhu, IJNME 33 (1992) 1331-1364.)
class DisplacementRecovery {
 public:
  DisplacementRecovery(const BoundaryMesh& mesh, const TractionSlots& slots)
      : mesh_(mesh), slots_(slots), trianglesOfSlot_(slots.slots.size()) {
    for (int t = 0; t < mesh.triangleCount(); ++t)
      for (const int slot : slots.ofCorner[t]) trianglesOfSlot_[slot].push_back(t);
  }

  /// The bulge b_ab of the edge from corner `a` of a triangle to the next one, as weights of nodal
  /// values: b_ab = sum_k weight_k u_k.
  std::map<int, double> bulge(int triangle, int a) const;

  /// Triangles that share a slot.
  const std::vector<int>& trianglesAround(int slot) const { return trianglesOfSlot_[slot]; }

 private:
  /// Adds factor * (grad u at the slot) . direction, as weights of nodal values.
  void addGradient(int slot, const Eigen::Vector3d& direction, double factor,
                   std::map<int, double>& weights) const;

  const BoundaryMesh& mesh_;
  const TractionSlots& slots_;
  std::vector<std::vector<int>> trianglesOfSlot_;
};

}  // namespace palpa::bem

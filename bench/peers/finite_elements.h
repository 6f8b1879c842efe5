#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "base/job.h"
#include "bem/model/material.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// Linear elasticity on tetrahedra with linear or quadratic isoparametric displacements, with the
/// nodes of tagged faces fixed. Unknowns: three per free node, in the order of the nodes.
struct FiniteElements {
  std::vector<int> freeOfNode;   ///< index of a node among the free nodes; -1: fixed
  std::vector<int> fixedOfNode;  ///< index among the fixed nodes; -1: free
  int freeCount = 0, fixedCount = 0;

  /// Lower triangle of the stiffness of the free nodes, N/mm.
  Eigen::SparseMatrix<double> stiffness;
  /// Stiffness that couples free nodes (rows) to fixed nodes.
  Eigen::SparseMatrix<double> coupling;

  /// Assembles on the job's threads.
  FiniteElements(const TetrahedralMesh& mesh, const bem::Material& material, const Job& job);
};

}  // namespace palpa::bench

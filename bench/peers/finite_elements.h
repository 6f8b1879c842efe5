#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "base/job.h"
#include "bem/model/material.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// Linear elasticity on tetrahedra with linear or quadratic isoparametric displacements, with the
/// nodes of tagged faces held. Unknowns: three per free node, in the order of the nodes.
struct FiniteElements {
  std::vector<int> freeOfNode;  ///< place of a node among the free ones; -1: held
  std::vector<int> heldOfNode;  ///< the same among those held
  int freeCount = 0, heldCount = 0;

  /// Lower triangle of the stiffness of the free nodes, N/mm.
  Eigen::SparseMatrix<double> stiffness;
  /// Stiffness that couples free nodes (rows) to those held.
  Eigen::SparseMatrix<double> coupling;

  /// Assembles on the job's threads.
  FiniteElements(const TetrahedralMesh& mesh, const bem::Material& material, const Job& job);
};

}  // namespace palpa::bench

#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "bem/linalg/capacitance_matrix.h"
#include "bem/problem/greens_function.h"

namespace palpa::bem {

/// The seed's Capacitance Matrix Algorithm: nodes whose type of boundary condition is exchanged (a
/// free node is given a displacement, a held node a traction) without solving the large system
/// again (James & Pai, ArtDefo, SIGGRAPH 1999, sect. 4; Jun & Cho, sect. 3.2). With E the columns
/// of the identity of the switched degrees of freedom S,
///   C = -E^T Xi E,   v0 = [Xi (I - E E^T) - E E^T] v̄,   v = v0 + (E + Xi E) C^-1 E^T v0.
///
/// Where coefficients are not values, as those of splines, what is given at a free one is the
/// displacement at its place, a weighted sum of coefficients: E^T on the left becomes R, whose rows
/// are these weights.
class NodalSwitching {
 public:
  /// `known`: the known values of the reference problem (dofs().nodalCount() rows, scaled tractions
  /// and mm); `unknown`: its solution v for them and for all loads; `field`: the whole field, loads
  /// included. `weights`: of the displacement coefficients in the displacement at the place of each
  /// (Discretisation::placeWeights()); empty when that is the coefficient itself.
  using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  NodalSwitching(std::shared_ptr<GreensFunction> greens, Eigen::VectorXd known,
                 Eigen::VectorXd unknown, BoundaryField field, Weights weights = {});

  /// Switches all three degrees of freedom of a node, or switches them back. A node may be switched
  /// once; an extra traction at an edge between two supports is not part of it.
  void add(int node);
  void remove(int node);
  const std::vector<int>& nodes() const { return nodes_; }

  /// The new known values of the switched nodes, 3 per node in their frames and in the order of
  /// nodes(): displacement at its place in mm for a node that was free, traction / tractionScale
  /// for one that was held.
  struct Solution {
    Eigen::VectorXd v;         ///< all unknowns; those of switched nodes are of the other kind
    Eigen::VectorXd switched;  ///< the unknowns of the switched degrees of freedom, 3 per node
    BoundaryField field;
  };
  Solution solve(const Eigen::VectorXd& values) const;

 private:
  struct Term {
    int dof;
    double weight;
  };
  /// What is given at a switched degree of freedom, in terms of the others.
  struct Row {
    std::vector<Term> unknown, known;  ///< of v, of held displacements
    double rest = 0;                   ///< what the reference problem has beside the unknown terms
    bool isOwnUnknown = true;
  };
  std::vector<int> dofsOf(int node) const { return {3 * node, 3 * node + 1, 3 * node + 2}; }
  Row rowOf(int dof) const;
  /// Rows [first, …) of R for states that are columns of v, each for a unit of the known value of
  /// the degrees of freedom of `nodes`, three columns each.
  Eigen::MatrixXd measure(std::size_t first, const Eigen::MatrixXd& states,
                          const std::vector<int>& nodes) const;

  std::shared_ptr<GreensFunction> greens_;
  Eigen::VectorXd known_, unknown_;
  BoundaryField field_;
  Weights weights_;
  std::vector<int> nodes_;
  std::vector<Row> rows_;    ///< three per node
  Eigen::MatrixXd columns_;  ///< Xi E
  CapacitanceMatrix capacitance_;
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "bem/linalg/capacitance_matrix.h"
#include "bem/problem/reference_problem.h"

namespace palpa::bem {

/// Capacitance Matrix Algorithm: exchanges the type of boundary condition of nodes (a free node
/// gets a prescribed displacement, a fixed node a traction) without solving the large system again
/// (James & Pai, ArtDefo, SIGGRAPH 1999, sect. 4; Jun & Cho, sect. 3.2). With E the columns of the
/// identity for the switched degrees of freedom S,
///   C = -E^T Xi E,   v0 = [Xi (I - E E^T) - E E^T] v̄,   v = v0 + (E + Xi E) C^-1 E^T v0.
///
/// Spline coefficients are not values: the prescribed value at a free coefficient is the
/// displacement at its place, a weighted sum of coefficients. The left factor E^T then becomes R,
/// whose rows are these weights.
class NodalSwitching {
 public:
  /// `known`: the known values of the reference problem (dofs().nodalCount() rows, scaled tractions
  /// and mm); `unknown`: its solution v for them and for all loads; `field`: the whole field
  /// including loads. `weights`: weights of the displacement coefficients in the displacement at
  /// each place (Discretisation::placeWeights()); empty if that displacement is the coefficient
  /// itself.
  using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  NodalSwitching(std::shared_ptr<const ReferenceProblem> problem, Eigen::VectorXd known,
                 Eigen::VectorXd unknown, BoundaryField field, Weights weights = {});

  /// Switches all three degrees of freedom of a node, or switches them back. A node may be switched
  /// once; an extra traction at an edge between two supports is not included.
  void add(int node);
  void remove(int node);
  const std::vector<int>& nodes() const { return nodes_; }

  /// Solution for new known values of the switched nodes.
  struct Solution {
    Eigen::VectorXd v;         ///< all unknowns; at switched nodes of the exchanged kind
    Eigen::VectorXd switched;  ///< the unknowns of the switched degrees of freedom, 3 per node
    BoundaryField field;
  };
  /// Solves for `values`: 3 per switched node in its frame, in the order of nodes(): the
  /// displacement at its place (mm) for a node that was free, traction / tractionScale for a node
  /// that was fixed.
  Solution solve(const Eigen::VectorXd& values) const;

 private:
  struct Term {
    int dof;
    double weight;
  };
  /// Prescribed value of a switched degree of freedom in terms of the other values.
  struct Row {
    std::vector<Term> unknown, known;  ///< of v, of prescribed displacements
    double rest = 0;  ///< remainder in the reference problem besides the unknown terms
    bool isOwnUnknown = true;
  };
  std::vector<int> dofsOf(int node) const { return {3 * node, 3 * node + 1, 3 * node + 2}; }
  Row rowOf(int dof) const;
  /// Rows [first, …) of R for states that are columns of v: three columns per node of `nodes`, for
  /// unit known values of its degrees of freedom.
  Eigen::MatrixXd measure(std::size_t first, const Eigen::MatrixXd& states,
                          const std::vector<int>& nodes) const;

  std::shared_ptr<const ReferenceProblem> problem_;
  Eigen::VectorXd known_, unknown_;
  BoundaryField field_;
  Weights weights_;
  std::vector<int> nodes_;
  std::vector<Row> rows_;    ///< three per node
  Eigen::MatrixXd columns_;  ///< Xi E
  CapacitanceMatrix capacitance_;
};

}  // namespace palpa::bem

#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

namespace palpa::bem {

/// Precomputed data of each curved element of a surface for contacts, and the adjacency of the
/// elements. Immutable once a subclass has filled it.
class ContactElements {
 public:
  struct Element {
    std::vector<int> coefficients;  ///< displacement coefficients, each once
    std::vector<int> slots;         ///< their traction slots
    /// Gauss points for bumps, one per row. `project` maps values at these points to contributions
    /// to the coefficients of the projection.
    Eigen::MatrixX3d bumpPoints;
    Eigen::VectorXd bumpWeights;  ///< mm^2
    Eigen::MatrixXd project;      ///< [coefficient][point]
    Eigen::MatrixXd moments;      ///< [coefficient][point]: N_a of displacements times weight, mm^2
    Eigen::MatrixXd mass;         ///< ∫ N_a N_b dΓ, mm^2: a of displacements, b of tractions
    /// Bounding sphere of bumpPoints, mm.
    Eigen::Vector3d center;
    double radius;
  };
  int count() const { return static_cast<int>(elements_.size()); }
  const Element& operator[](int element) const { return elements_[element]; }
  /// Elements on which the function of a displacement coefficient is nonzero.
  const std::vector<int>& around(int coefficient) const { return around_[coefficient]; }

  /// Cells are knot rectangles: one element, or the pieces of a cut one.
  int cellCount() const { return static_cast<int>(cells_.size()); }
  int cellOf(int element) const { return cellOf_[element]; }
  const std::vector<int>& elementsOf(int cell) const { return cells_[cell].elements; }
  /// Calls visit(cell) for every cell that shares a side with `cell` if this side reaches into the
  /// ball of `radius` (mm) around `middle`.
  template <class Visit>
  void visitNeighbours(int cell, const Eigen::Vector3d& middle, double radius,
                       const Visit& visit) const {
    for (const Side& side : cells_[cell].sides)
      if (reaches(side, middle, radius))
        for (const int neighbour : side.neighbours) visit(neighbour);
  }

 protected:
  ContactElements() = default;
  /// Completes the list of elements around each coefficient.
  void setAround(int coefficientCount);

  static constexpr int kPieces = 8;  // of a side, each taken as straight
  struct Side {
    std::array<Eigen::Vector3d, kPieces + 1> points;
    double radius;  // around the middle point
    std::vector<int> neighbours;
  };
  struct Cell {
    std::vector<int> elements;
    std::array<Side, 4> sides;
  };
  static bool reaches(const Side& side, const Eigen::Vector3d& middle, double radius);

  std::vector<Element> elements_;
  std::vector<std::vector<int>> around_;
  std::vector<Cell> cells_;
  std::vector<int> cellOf_;
};

}  // namespace palpa::bem

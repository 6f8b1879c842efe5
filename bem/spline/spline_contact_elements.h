#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "bem/spline/spline_tractions.h"

namespace palpa::bem {

/// Of each element of a spline surface what contacts need, computed beforehand, and which elements
/// hang together. Immutable.
class SplineContactElements {
 public:
  /// `narrowest`: per displacement coefficient, mm: bumps are integrated well from that radius on.
  SplineContactElements(const SplineSurface& surface, const SplineTractions& tractions,
                        const std::vector<double>& narrowest);

  struct Element {
    std::vector<int> coefficients;  ///< of displacement, each once
    std::vector<int> slots;         ///< their tractions
    /// Gauss points for bumps (rows), and the contributions of values at them to the coefficients
    /// of the projection.
    Eigen::MatrixX3d bumpPoints;
    Eigen::VectorXd bumpWeights;  ///< mm^2
    Eigen::MatrixXd project;      ///< [coefficient][point]
    Eigen::MatrixXd mass;         ///< ∫ N_a N_b dΓ, mm^2
    /// Gauss points for the mean of smooth functions over a mask, and basis times weight there.
    Eigen::Matrix3Xd points;
    Eigen::MatrixXd weightedBasis;  ///< [point][coefficient], mm^2
    /// Around bumpPoints.
    Eigen::Vector3d center;
    double radius;
  };
  int count() const { return static_cast<int>(elements_.size()); }
  const Element& operator[](int element) const { return elements_[element]; }
  /// The elements in which a displacement coefficient's function is not zero.
  const std::vector<int>& around(int coefficient) const { return around_[coefficient]; }

  /// Knot rectangles: elements, or several that were cut from one.
  int cellCount() const { return static_cast<int>(cells_.size()); }
  int cellOf(int element) const { return cellOf_[element]; }
  const std::vector<int>& elementsOf(int cell) const { return cells_[cell].elements; }
  /// Calls visit(cell) for the cells that meet one in a side which reaches into a ball.
  template <class Visit>
  void visitNeighbours(int cell, const Eigen::Vector3d& middle, double radius,
                       const Visit& visit) const {
    for (const Side& side : cells_[cell].sides)
      if (reaches(side, middle, radius))
        for (const int neighbour : side.neighbours) visit(neighbour);
  }

 private:
  static constexpr int kPieces = 8;  // of a side, taken as straight
  struct Side {
    std::array<Eigen::Vector3d, kPieces + 1> points;
    double radius;  // around the middle one
    std::vector<int> neighbours;
  };
  struct Cell {
    std::vector<int> elements;
    std::array<Side, 4> sides;
  };
  static bool reaches(const Side& side, const Eigen::Vector3d& middle, double radius);
  void connectCells(const SplineSurface& surface);
  void fill(const SplineSurface& surface, const SplineTractions& tractions, int index,
            const std::vector<double>& narrowest);

  std::vector<Element> elements_;
  std::vector<std::vector<int>> around_;
  std::vector<Cell> cells_;
  std::vector<int> cellOf_;
};

}  // namespace palpa::bem

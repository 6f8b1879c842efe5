#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bem/element/element_equations.h"
#include "bem/element/element_rows.h"

namespace palpa::bem {

/// What averaged elements add to the rows of their equations: the integrals over near elements,
/// less what the rows of their nodes have of these. The rows of a node leave out the elements that
/// are near to all averaged elements at the node. All references must outlive the object; const use
/// from several threads is safe.
class AveragedRows {
 public:
  /// `part`: ascending elements over which integrals are taken, without subtraction; none: all.
  AveragedRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
               const KelvinConstants& constants, const WeightedEquations& equations,
               std::optional<std::span<const int>> part);

  /// Ascending elements that the row of a point leaves out.
  std::span<const int> leftOut(std::size_t point) const { return leftOut_[point]; }

  /// Sum of T over all functions for a point of WeightedEquations, as in ElementRows::Sums.
  using Total = std::array<double, kKernelSumsT>;

  /// The rows of an averaged element's equations at the functions of near elements.
  struct Blocks {
    std::vector<int> coefficients, slots;
    Eigen::MatrixXd H, G;  ///< [3 equation + i][3 function + c]
  };
  struct Scratch {
    std::unique_ptr<ElementQuadrature::Workspace> quadrature;
    std::vector<int> placeOfCoefficient, placeOfSlot, elements;
    Eigen::MatrixXd T, U, ofT, ofU;
    std::vector<double> basis;
  };
  Scratch makeScratch() const;
  /// `totals`: one per point of the equations, of the rows without what they leave out.
  Blocks blocks(const AveragedElement& element, std::span<const Total> totals,
                Scratch& scratch) const;

 private:
  void number(const AveragedElement& element, Blocks& blocks, Scratch& scratch) const;
  void addSums(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
               Eigen::Index column, Scratch& scratch) const;
  void subtractTranslation(const AveragedElement& element, std::span<const Total> totals,
                           Scratch& scratch) const;
  std::span<const int> inPart(std::span<const int> elements, std::vector<int>& chosen) const;

  const ElementSurface& surface_;
  const ElementQuadrature& quadrature_;
  const KelvinConstants constants_;
  const WeightedEquations& equations_;
  const std::optional<std::span<const int>> part_;
  KelvinSumLoops loops_;
  std::vector<std::vector<int>> leftOut_;
};

}  // namespace palpa::bem

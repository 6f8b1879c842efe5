#pragma once

#include <array>
#include <vector>

#include "base/job.h"
#include "bem/element/element_quadrature.h"
#include "bem/element/polar_rule.h"
#include "bem/quadratic/quadratic_kernel.h"
#include "bem/quadratic/quadratic_surface.h"

namespace palpa::bem {

/// Integrates Kelvin's kernels times the functions of quadratic triangles for any collocation
/// point. Far elements use one of four rules (7 to 64 points), selected by their distance over
/// their radius. Nearer elements are quartered until a rule suffices. An element that contains the
/// point is divided while it is elongated or its metric varies; the part that still contains the
/// point is integrated in polar coordinates around it, in which all integrands are smooth. The part
/// of T without a limit cancels in the assembly.
///
/// Memory: about 15 KiB per element.
class QuadraticQuadrature final : public ElementQuadrature {
 public:
  /// `tolerance`: relative error allowed in the integrals over one element, [1e-12, 1e-2]. The
  /// surface must outlive the quadrature.
  QuadraticQuadrature(const QuadraticSurface& surface, double tolerance);

  std::unique_ptr<Workspace> makeWorkspace() const override;
  double distance(int element, const Eigen::Vector3d& x) const override {
    return (x - elements_[element].whole.center).norm() - elements_[element].whole.radius;
  }
  int keptRule(int element, const Eigen::Vector3d& x) const override {
    const Cell& whole = elements_[element].whole;
    return ruleFor(element, (x - whole.center).norm() / whole.radius, 0);
  }
  const ElementPoints& keptPoints(int element, int rule) const override {
    return elements_[element].rules[rule];
  }
  const ElementPoints& points(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                              Workspace& work) const override;
  void visitRules(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                  Workspace& work, const Visit& visit) const override;
  void integrate(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                 Workspace& work) const override;

 private:
  /// Triangle in the local coordinates of an element, counter-clockwise.
  using Corners = std::array<Eigen::Vector2d, 3>;
  struct Cell {
    Corners corners;
    Eigen::Vector3d center;
    double radius;
    int longest;    ///< edge from corner k to the next one
    double aspect;  ///< its length over the height upon it, as of the flat triangle
  };
  struct Element {
    Cell whole;
    std::array<ElementPoints, kKeptRules> rules;
    std::array<double, kKeptRules> curvatureError{};  ///< relative
  };
  /// The smallest rule that suffices for a cell made by `depth` quarterings, at a distance over its
  /// radius; -1: none.
  int ruleFor(int element, double ratio, int depth) const;
  int maxDepth(int element) const;
  Cell cellIn(int element, const Corners& corners) const;
  void addRule(const Corners& corners, int rule, ElementRule& to) const;
  void place(int element, ElementRule& rule, ElementPoints& points) const;
  void addNear(int element, const Cell& cell, const Eigen::Vector3d& x, int depth,
               ElementRule& to) const;
  void addSingular(int element, const Cell& cell, const Eigen::Vector3d& x,
                   const ElementPlace& place, int depth, ElementRule& to) const;
  void collect(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
               Workspace& work) const;

  const QuadraticSurface& surface_;
  KelvinSumLoops loops_;
  QuadraticKernel kernel_;
  SingularAccuracy accuracy_;
  double tolerance_;
  /// Smallest distance over radius of each rule, and with BorderCoordinates.
  std::array<double, kKeptRules> ratio_, borderRatio_;
  std::vector<Element> elements_;
};

}  // namespace palpa::bem

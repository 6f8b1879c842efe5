#pragma once

#include <array>
#include <vector>

#include "base/job.h"
#include "bem/element/element_quadrature.h"
#include "bem/spline/spline_placement.h"
#include "bem/spline/spline_singular_rule.h"

namespace palpa::bem {

/// Integrates Kelvin's kernels times the functions of spline elements for any collocation point.
/// Far elements use a tensor Gauss rule of 3 to 8 points per direction, selected by their distance
/// over their radius. Nearer elements are subdivided until the rule of 8 points suffices. An
/// element that contains the point is subdivided while it is elongated; the part that still
/// contains the point is integrated in polar coordinates around the point in the surface metric
/// there, in which all integrands are smooth. The part of T without a limit cancels in the
/// assembly. Where the metric is singular (a corner in which both derivatives are parallel), cells
/// are halved towards the point instead.
///
/// Const use from several threads is safe if each thread has its own Workspace. Memory: about 90
/// points per element.
class SplineQuadrature final : public ElementQuadrature {
 public:
  static constexpr int kMinPoints = 3,
                       kMaxPoints = 8;  ///< points per direction of the tensor rules

  /// `tolerance`: relative error allowed in the integrals over one element, [1e-12, 1e-2]. The
  /// surface must outlive the quadrature. Takes about 3 µs per element and core; the result does
  /// not depend on the number of threads. Throws Cancelled if the job was stopped.
  SplineQuadrature(const SplineSurface& surface, double tolerance, const Job& job = {});

  std::unique_ptr<Workspace> makeWorkspace() const override;

  /// Distance of a point (mm) from the centre of an element over the element's radius.
  double ratio(int element, const Eigen::Vector3d& x) const {
    return (x - elements_[element].whole.center).norm() / elements_[element].whole.radius;
  }
  double distance(int element, const Eigen::Vector3d& x) const override {
    return (x - elements_[element].whole.center).norm() - elements_[element].whole.radius;
  }
  int keptRule(int element, const Eigen::Vector3d& x) const override {
    const int count = pointsFor(elements_[element], ratio(element, x));
    return count > 0 && count <= kMaxKept ? count - kMinPoints : -1;
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
  /// Larger rules are needed only near elements.
  static constexpr int kMaxKept = kMinPoints + kKeptRules - 1;

  struct Scratch;
  struct Cell {
    SplineCell cell;
    Eigen::Vector3d center;
    double radius;
    std::array<double, 2> length;        ///< of the middle lines along u and v, mm
    std::array<double, 4> cornerMetric;  ///< area per unit of the parameters

    int longer() const { return length[0] >= length[1] ? 0 : 1; }
    bool isLong() const { return length[longer()] > kMaxAspect * length[1 - longer()]; }
  };
  struct Element {
    Cell whole;
    std::vector<Cell> parts;  ///< after the first subdivision
    /// Smallest distance over radius at which each number of points per direction suffices.
    std::array<double, kMaxPoints + 1> ratio;
    std::array<ElementPoints, kKeptRules> rules;
  };
  /// Cells with a larger aspect ratio are subdivided before the polar rule, because radii would
  /// vary too much over the angles.
  static constexpr double kMaxAspect = 1.7;

  /// Calls visit(points) for each rule.
  template <class Use>
  void useRules(int element, const Eigen::Vector3d& x, const ElementPlace* inside, Scratch& work,
                const Use& use) const;
  void prepare(int element, Scratch& work);
  /// Integrals of the functions times the area vectors: a minimum requirement for a rule at any
  /// distance.
  std::vector<double> moments(int element, const ElementPoints& points) const;
  int pointsFor(const Element& element, double ratio) const;
  static void reduceSums(const BorderFunctions& functions, const std::vector<KernelSums>& ofTable,
                         std::vector<KernelSums>& sums);
  Cell cellIn(int element, const SplineCell& cell, Scratch& work) const;
  /// Halves an elongated cell and quarters other cells.
  void divide(int element, const Cell& cell, Scratch& work, std::vector<Cell>& parts) const;
  void addNear(int element, const Cell& cell, const Eigen::Vector3d& x, int depth,
               Scratch& work) const;
  void addSingular(int element, const Cell& cell, const Eigen::Vector3d& x,
                   const ElementPlace& place, int depth, Scratch& work) const;
  /// True if the metric at a place differs from the rest of a cell, as in a corner where it
  /// vanishes.
  bool metricVaries(const Cell& cell, const ElementPlace& place) const;
  /// Collects the points of a polar rule in work.rule, and the cells of tensor rules in work.cells.
  void collect(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
               Scratch& work) const;

  const SplineSurface& surface_;
  SplinePlacement placement_;
  KelvinSumLoops loops_;
  SingularAccuracy accuracy_;
  int cornerLevels_;  ///< halvings towards a corner with a singular metric
  std::vector<Element> elements_;
};

}  // namespace palpa::bem

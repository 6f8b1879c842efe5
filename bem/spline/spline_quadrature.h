#pragma once

#include <array>
#include <vector>

#include "base/job.h"
#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_points.h"
#include "bem/spline/spline_singular_rule.h"

namespace palpa::bem {

/// Integrates Kelvin's kernels times the functions of spline elements, from any collocation point.
/// Far elements take a tensor Gauss rule of 3 to 8 points per direction by their distance over
/// their radius; nearer ones are divided until the rule of 8 does. An element that contains the
/// point is divided while it is long, and what still contains it is integrated in polar coordinates
/// around the point in the metric of the surface there, in which all integrands are smooth; the
/// part of T that has no limit drops out in the assembly. Where the surface has no metric, in a
/// corner in which both derivatives are parallel, cells are halved towards the point instead.
///
/// Const use from several threads is safe, each with a Workspace of its own. Memory: about 90
/// points per element.
class SplineQuadrature {
 public:
  static constexpr int kMinPoints = 3,
                       kMaxPoints = 8;  ///< points per direction of the tensor rules

  /// `tolerance`: relative error allowed in the integrals over one element, [1e-12, 1e-2]. The
  /// surface must outlive it. About 3 µs per element and core; does not depend on the number of
  /// threads. Throws Cancelled.
  SplineQuadrature(const SplineSurface& surface, double tolerance, const Job& job = {});

  /// Memory of one thread, and what integrate() leaves behind.
  struct Workspace {
    std::vector<KernelSums> sums;  ///< per function, see spline_kernel.h

    // Scratch: points of polar rules, cells with the points per direction of their tensor rules,
    // and outlines of cells.
    SplineRule rule, outline;
    SplinePoints points, outlinePoints;
    std::vector<std::pair<SplineCell, int>> cells;
  };

  /// Distance of a point from the middle of an element over the element's radius.
  double ratio(int element, const Eigen::Vector3d& x) const {
    return (x - elements_[element].whole.center).norm() / elements_[element].whole.radius;
  }
  /// mm from an element, at least; less where the element leaves its ball.
  double distance(int element, const Eigen::Vector3d& x) const {
    return (x - elements_[element].whole.center).norm() - elements_[element].whole.radius;
  }
  int stride(int element) const { return placement_.stride(element); }

  /// The points at which integrate() sums: valid until the workspace is used again.
  const SplinePoints& points(int element, const Eigen::Vector3d& x, const SplinePlace* inside,
                             Workspace& work) const;

  /// Sums of one element from x, into work.sums. `inside`: the place of x in the element, null when
  /// the element does not contain it.
  void integrate(int element, const Eigen::Vector3d& x, const SplinePlace* inside,
                 Workspace& work) const;
  /// Adds work.sums to those of the coefficients of an element's functions, [coefficient]
  /// [kKernelSumsT] and [slot][kKernelSumsU].
  void addTo(const std::vector<int>& coefficients, const std::vector<int>& slots,
             const Workspace& work, double* T, double* U) const;

 private:
  static constexpr int kMaxKept = 6;  ///< larger rules are needed near elements only

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
    std::vector<Cell> parts;  ///< the first division
    /// From how many radii on so many points per direction do.
    std::array<double, kMaxPoints + 1> ratio;
    std::array<SplinePoints, kMaxKept - kMinPoints + 1> rules;
  };
  /// Cells longer than this are divided before the polar rule: beyond, radii vary too much over the
  /// angles.
  static constexpr double kMaxAspect = 1.7;

  void prepare(int element, Workspace& work);
  /// Integrals of the functions times the area vectors: what a rule must do, however far the point.
  std::vector<double> moments(int element, const SplinePoints& points) const;
  int pointsFor(const Element& element, double ratio) const;
  Cell cellIn(int element, const SplineCell& cell, Workspace& work) const;
  /// Halves of a long cell, quarters of others.
  void divide(int element, const Cell& cell, Workspace& work, std::vector<Cell>& parts) const;
  void addNear(int element, const Cell& cell, const Eigen::Vector3d& x, int depth,
               Workspace& work) const;
  void addSingular(int element, const Cell& cell, const Eigen::Vector3d& x,
                   const SplinePlace& place, int depth, Workspace& work) const;
  /// Is the metric at a place another than elsewhere in a cell, as in a corner where it vanishes?
  bool metricVaries(const Cell& cell, const SplinePlace& place) const;
  /// The points of a polar rule into work.rule, and work.cells.
  void collect(int element, const Eigen::Vector3d& x, const SplinePlace* inside,
               Workspace& work) const;

  const SplineSurface& surface_;
  SplinePlacement placement_;
  SplineKernel kernel_;
  SingularAccuracy accuracy_;
  int cornerLevels_;  ///< halvings towards a corner where the surface has no metric
  std::vector<Element> elements_;
};

}  // namespace palpa::bem

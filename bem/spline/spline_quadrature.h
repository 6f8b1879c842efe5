#pragma once
#include <array>
#include <vector>

#include "bem/job.h"
#include "bem/spline/spline_collocation.h"
#include "bem/spline/spline_points.h"

namespace palpa::bem {

/// Integrates Kelvin's kernels times the functions of spline elements, from any collocation point.
/// Far elements take a tensor Gauss rule of 3 to 6 points per direction by their distance over
/// their radius; nearer ones are divided until the rule of 6 does. An element that contains the
/// point is divided while it is long, and what still contains it is integrated in polar coordinates
/// around the point in the metric of the surface there, in which all integrands are smooth; the
/// part of T that has no limit drops out in the assembly. Where the surface has no metric, in a
/// corner in which both derivatives are parallel, cells are halved towards the point instead.
///
/// Const use from several threads is safe, each with a Workspace of its own. Memory: about 86
/// points per element.
class SplineQuadrature {
 public:
  static constexpr int kFewest = 3, kMost = 6;  ///< points per direction of the tensor rules

  /// `tolerance`: relative error allowed in the integrals over one element, [1e-12, 1e-2]. The
  /// surface must outlive it. About 20 µs per element and core; does not depend on the number of
  /// threads. Throws Cancelled.
  SplineQuadrature(const SplineSurface& surface, double tolerance, const Job& job = {});

  /// Memory of one thread, and what integrate() leaves behind.
  struct Workspace {
    SplineRule rule;
    SplinePoints points;
    std::vector<double> kernels;
    /// [kKernelSums][stride]: see spline_kernel.h; stride = stride(element).
    std::vector<double> sums;
  };

  /// Distance of a point from the middle of an element over the element's radius.
  double ratio(int element, const Eigen::Vector3d& x) const {
    return (x - elements_[element].ball.center).norm() / elements_[element].ball.radius;
  }
  /// mm from an element, at least; less where the element leaves its ball.
  double distance(int element, const Eigen::Vector3d& x) const {
    return (x - elements_[element].ball.center).norm() - elements_[element].ball.radius;
  }
  int stride(int element) const { return placement_.stride(element); }

  /// The points at which integrate() sums: valid until the workspace is used again.
  const SplinePoints& points(int element, const Eigen::Vector3d& x, const SplinePlace* inside,
                             Workspace& work) const;

  /// Sums of one element from x, into work.sums. `inside`: the place of x in the element, null when
  /// the element does not contain it.
  void integrate(int element, const Eigen::Vector3d& x, const SplinePlace* inside,
                 Workspace& work) const;

 private:
  struct Ball {
    Eigen::Vector3d center;
    double radius;
  };
  struct Element {
    Ball ball;
    /// From how many radii on so many points per direction do.
    std::array<double, kMost + 1> ratio;
    std::array<SplinePoints, kMost - kFewest + 1> rules;
  };

  void prepare(int element, Workspace& work);
  /// Integrals of the functions times the area vectors: what a rule must do, however far the point.
  std::vector<double> moments(int element, const SplinePoints& points) const;
  int pointsFor(const Element& element, double ratio) const;
  Ball ballAround(int element, const SplineCell& cell) const;
  std::array<double, 2> lengths(int element, const SplineCell& cell) const;
  void addNear(int element, const SplineCell& cell, const Ball& ball, const Eigen::Vector3d& x,
               int depth, Workspace& work) const;
  void addSingular(int element, const SplineCell& cell, const Eigen::Vector3d& x,
                   const SplinePlace& place, int depth, Workspace& work) const;
  /// Is the metric at a place another than elsewhere in a cell, as in a corner where it vanishes?
  bool metricVaries(const SplineCell& cell, const SplinePlace& place) const;
  bool isFoldedCorner(const SplineCell& cell, const SplinePlace& place) const;
  void addFoldedCorner(const SplineCell& cell, const SplinePlace& place, Workspace& work) const;
  void addPolar(const SplineCell& cell, const SplinePlace& place, Workspace& work) const;

  const SplineSurface& surface_;
  SplinePlacement placement_;
  SplineKernel kernel_;
  double error_;
  int radial_;        ///< points of the polar rule towards the cell's border
  int cornerLevels_;  ///< halvings towards a corner where the surface has no metric
  std::vector<Element> elements_;
};

}  // namespace palpa::bem

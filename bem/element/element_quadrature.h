#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bem/element/element_points.h"
#include "bem/element/element_surface.h"

namespace palpa::bem {

/// Integrates Kelvin's kernels times the functions of curved elements for any collocation point,
/// with stored quadrature points for distant elements. Const use from several threads is safe if
/// each thread has its own Workspace.
class ElementQuadrature {
 public:
  virtual ~ElementQuadrature() = default;

  /// Memory of one thread, including the result of integrate().
  struct Workspace {
    virtual ~Workspace() = default;
    std::vector<KernelSums> sums;  ///< per function, see kelvin_sums.h
    ElementRule rule;
    ElementPoints points;
  };
  virtual std::unique_ptr<Workspace> makeWorkspace() const = 0;

  /// Estimated distance of a point from an element, mm: distance from its bounding sphere. It is a
  /// lower bound, except where the element leaves the sphere.
  virtual double distance(int element, const Eigen::Vector3d& x) const = 0;

  /// Rules whose points are kept for every element.
  static constexpr int kKeptRules = 4;
  /// The kept rule that suffices for a point outside of an element; -1: none does.
  virtual int keptRule(int element, const Eigen::Vector3d& x) const = 0;
  virtual const ElementPoints& keptPoints(int element, int rule) const = 0;

  /// Points at which integrate() sums; valid until the workspace is used again. `inside`: the place
  /// of x in the element; null if the element does not contain x.
  virtual const ElementPoints& points(int element, const Eigen::Vector3d& x,
                                      const ElementPlace* inside, Workspace& work) const = 0;

  /// Calls visit(points) for each rule that integrate() uses; they are valid during the call.
  using Visit = std::function<void(const ElementPoints&)>;
  virtual void visitRules(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                          Workspace& work, const Visit& visit) const = 0;

  /// Computes the sums of one element for x (mm) in work.sums.
  virtual void integrate(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                         Workspace& work) const = 0;
};

/// The place of a point in an element; null if the element does not contain the point.
const ElementPlace* placeIn(const CollocationPlace& point, int element);

/// Surface point nearest to x (mm); for points far from the surface, one of the nearest.
ElementFoot nearestOnSurface(const ElementSurface& surface, const ElementQuadrature& quadrature,
                             const Eigen::Vector3d& x);

}  // namespace palpa::bem

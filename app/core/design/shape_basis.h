#pragma once

#include <Eigen/Dense>
#include <vector>

#include "bem/gradient/boundary_form.h"
#include "bem/gradient/field_sampler.h"
#include "bem/gradient/shape_density.h"
#include "modeling/solid/edge_curve.h"
#include "modeling/solid/solid.h"

namespace palpa::app {

/// Motion of surface points by the motion of a solid's control points: V(x_q) = Σ_j N_j(x_q) dP_j
/// and its derivatives along the two tangents of the point's frame. Const use from several threads
/// is safe. Memory: about 600 bytes per point of a cubic patch.
class ShapeBasis {
 public:
  /// The solid is copied.
  explicit ShapeBasis(modeling::Solid solid) : solid_(std::move(solid)) {}

  /// Adds the points of one element at the given places; `points`: their frames.
  void add(const std::vector<modeling::SurfaceParameter>& places,
           const std::vector<bem::SampledPoint>& points);

  const modeling::Solid& solid() const { return solid_; }
  int pointCount() const { return static_cast<int>(first_.size()) - 1; }

  /// Derivative by the control points, one column each: Σ_q value_q N_j + Σ_a slope_qa ∂N_j/∂t_a.
  /// The centres of masks are left out.
  Eigen::Matrix3Xd gradient(const bem::ShapeDensity& density) const;

  /// Motion of the points [first, first + count).
  bem::BoundaryForm::Motion motion(int first, int count) const;

  /// Places of the points, in their order.
  const std::vector<modeling::SurfaceParameter>& places() const { return places_; }

 private:
  struct Weight {
    int controlPoint;
    double value, first, second;  ///< N, ∂N/∂t_1, ∂N/∂t_2
  };
  modeling::Solid solid_;
  std::vector<modeling::SurfaceParameter> places_;
  std::vector<std::size_t> first_{0};
  std::vector<Weight> weights_;
};

}  // namespace palpa::app

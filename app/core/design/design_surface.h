#pragma once

#include <memory>

#include "app/core/design/shape_basis.h"
#include "app/core/model/touch_model.h"
#include "bem/gradient/field_sampler.h"
#include "bem/gradient/mask_derivative.h"
#include "bem/gradient/surface_rules.h"

namespace palpa::app {

/// Points of a rule over the surface of a model whose body is a solid: the fields there, and the
/// motion of the points by the control points. Const use from several threads is safe.
struct DesignSurface {
  bem::FieldSampler sampler;
  ShapeBasis basis;
};

/// Points at which the bump of a mask is integrated.
struct MaskSurface {
  bem::SampledElements sampled;
  bem::MaskShares shares;
  /// How the points move with the material points of bem::ResidualShape.
  std::unique_ptr<const bem::MovingElements> moving;
};

/// None for flat triangles, whose masks are projected otherwise. `surface`: of the model, which
/// must outlive the result.
std::optional<MaskSurface> makeMaskSurface(const TouchModel& model,
                                           const bem::ContactSurface& surface,
                                           const bem::ContactMask& mask);

/// Makes the points for a model: about 10,000 for a model of 1,000 coefficients. Takes about 5 µs
/// per point. Throws ModelingError if the body is a mesh body, which has no control points.
DesignSurface makeDesignSurface(const TouchModel& model);

}  // namespace palpa::app

#pragma once

#include <optional>

#include "app/core/design/design_surface.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// A measure of a solid and its derivative by the control points: one column each, in their order.
struct ShapeMeasure {
  double value = 0;
  Eigen::Matrix3Xd gradient;
};

/// Volume, mm^3, and its derivative, mm^2: exact to the rule of the surface.
ShapeMeasure volumeOf(const DesignSurface& surface);
/// Area, mm^2, and its derivative, mm.
ShapeMeasure areaOf(const DesignSurface& surface);
/// Mass, kg, and its derivative, kg/mm; none for a material without a density.
std::optional<ShapeMeasure> massOf(const DesignSurface& surface,
                                   const modeling::Material& material);
/// Smallest wall thickness at places all over the patches, mm, and its derivative: both ends move
/// with the material. Where several places are equally thin, it belongs to one of them. Costs about
/// a millisecond per place. None if no place has an opposite one.
std::optional<ShapeMeasure> smallestThickness(const modeling::Solid& solid);

}  // namespace palpa::app

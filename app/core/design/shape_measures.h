#pragma once

#include <array>
#include <optional>
#include <vector>

#include "app/core/design/design_surface.h"
#include "base/job.h"
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
/// Thickness of a wall at a place of a patch.
struct WallThickness {
  int patch = 0, place = 0;               ///< place: number within the patch
  double value = 0;                       ///< mm
  std::array<Eigen::Vector3d, 2> ends{};  ///< mm

  /// Derivative by the control points of the solid, one column each.
  Eigen::Matrix3Xd gradient(const modeling::Solid& solid) const;
};

/// Wall thicknesses at places all over the given patches; places without an opposite surface, which
/// faces away from them within 60° (25° on the same or a neighbouring patch), are left out. Costs
/// about a millisecond per place. Throws Cancelled.
std::vector<WallThickness> wallThicknesses(const modeling::Solid& solid,
                                           const std::vector<int>& patches, const Job& job = {});

/// Smallest wall thickness at places all over the patches, mm, and its derivative: both ends move
/// with the material. Where several places are equally thin, it belongs to one of them. Costs about
/// a millisecond per place. None if no place has an opposite one.
std::optional<ShapeMeasure> smallestThickness(const modeling::Solid& solid);

}  // namespace palpa::app

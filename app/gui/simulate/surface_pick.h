#pragma once

#include <optional>

#include "app/gui/simulate/simulation.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// A place on the body of Simulate mode, mm.
struct SurfacePick {
  Eigen::Vector3d at;      ///< on the unloaded shape
  Eigen::Vector3d drawn;   ///< as drawn
  Eigen::Vector3d normal;  ///< outward, unit, of the drawn shape
};

/// The place under a pixel; none beside the body.
std::optional<SurfacePick> pickSurface(const Simulation& simulation, const ViewportWidget& widget,
                                       const Eigen::Vector2d& pixel);

}  // namespace palpa::gui

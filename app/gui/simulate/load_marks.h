#pragma once

#include <optional>
#include <vector>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulation.h"
#include "app/view/scene/scene.h"
#include "bem/model/surface_point.h"

namespace palpa::gui {

/// Arrows of the loads in Simulate mode: as in Model mode, on the deformed body.
class LoadMarks {
 public:
  LoadMarks(const Editor& editor, const Settings& settings, const Simulation& simulation)
      : editor_(editor), settings_(settings), simulation_(simulation) {}

  /// Finds the places of the loads on the drawn body; none while it is older than the project,
  /// whose loads may refer to other patches.
  void find();
  /// Arrows at the displacements of the last frame. Microseconds per load.
  std::vector<view::ForceArrow> arrows() const;

 private:
  struct Mark {
    view::ForceArrow arrow;                    ///< on the unloaded body
    std::optional<bem::SurfacePoint> place{};  ///< none for a weight, which acts inside
  };

  const Editor& editor_;
  const Settings& settings_;
  const Simulation& simulation_;
  std::vector<Mark> marks_;
};

}  // namespace palpa::gui

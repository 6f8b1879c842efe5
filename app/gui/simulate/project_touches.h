#pragma once

#include <QTimer>

#include "app/gui/simulate/simulation.h"
#include "app/gui/simulate/touch_motion.h"

namespace palpa::gui {

/// Performs the touches of the project, as `palpa-cli touch` does: grabs, forces and pins within a
/// second, then fingertips and balls on the deformed surface within another. The contacts stay as
/// pins.
class ProjectTouches : public QObject {
  Q_OBJECT

 public:
  ProjectTouches(const Editor& editor, Simulation& simulation, QObject* parent);

  /// Ends all other contacts first. Does nothing without Simulation::drawn().
  void play();

 private:
  /// Begins the touches that press, or the others.
  void begin(bool pressing);

  const Editor& editor_;
  Simulation& simulation_;
  TouchMotion motion_;
  QTimer timer_;  // until the first part has settled
};

}  // namespace palpa::gui

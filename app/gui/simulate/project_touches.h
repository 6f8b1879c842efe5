#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <optional>
#include <vector>

#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Plays the touches of the project by hand, as `palpa-cli touch` does: grabs, forces and pins
/// within a second, then, from where these leave the surface, fingertips and balls within another.
/// They stay as pins.
class ProjectTouches : public QObject {
  Q_OBJECT

 public:
  ProjectTouches(const Editor& editor, Simulation& simulation, QObject* parent);

  /// Lets go of everything else first. Needs Simulation::drawn().
  void play();

 private:
  struct Motion {
    app::TouchId id;
    Eigen::Vector3d from, way;  // value, see bem::ContactSimulation::begin()
  };
  /// Begins those that press, or the others.
  void begin(bool pressing);
  std::optional<Motion> begin(const modeling::Touch& touch, bem::ContactTool::Kind kind);
  /// Is what was begun where it shall be, in the picture too?
  bool isSettled() const;
  void advance();

  const Editor& editor_;
  Simulation& simulation_;
  std::vector<Motion> motions_;
  bool isPressing_ = false;  // the second part has begun
  QElapsedTimer since_;
  QTimer timer_;
};

}  // namespace palpa::gui

#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <optional>
#include <vector>

#include "app/gui/simulate/simulation.h"

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
  struct Motion {
    app::TouchId id;
    Eigen::Vector3d from, by;  // of the value, see bem::ContactSimulation::begin()
  };
  /// Begins the touches that press, or the others.
  void begin(bool pressing);
  std::optional<Motion> begin(const modeling::Touch& touch);
  /// True if all begun contacts have reached their values, also in the drawn snapshot.
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

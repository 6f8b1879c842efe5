#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <optional>
#include <vector>

#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Begins stored or typed touches in the touch loop, as app::playTouches() does, and moves each to
/// its displacement or force within a second. The contacts stay until somebody ends them.
class TouchMotion : public QObject {
  Q_OBJECT

 public:
  TouchMotion(Simulation& simulation, QObject* parent);

  /// Begins a touch on the present deformed surface. Nothing if it is refused or without
  /// Simulation::drawn().
  std::optional<app::TouchId> begin(const modeling::Touch& touch);
  /// Forgets all motions; their contacts stay where they are.
  void stop();
  /// True if all begun contacts have reached their values, also in the drawn snapshot, or have
  /// ended.
  bool isSettled() const;

 private:
  struct Motion {
    app::TouchId id;
    Eigen::Vector3d from, by;  // of the value, see bem::ContactSimulation::begin()
    QElapsedTimer since;
  };
  void advance();

  Simulation& simulation_;
  std::vector<Motion> motions_;
  QTimer timer_;
};

}  // namespace palpa::gui

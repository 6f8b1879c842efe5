#pragma once

#include <QWidget>
#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// What all hand tools share and a person can set.
class SimulateOptions : public QObject {
  Q_OBJECT

 public:
  using Kind = bem::ContactTool::Kind;

  /// Does a contact of this kind press on the surface, so that it may slide?
  static bool isPushing(Kind kind) { return bem::ContactTool{kind}.isPushing(); }

  /// mm; that of a fingertip for the body when none was set.
  double radius(const app::DrawnBody& body) const;
  double friction() const { return friction_; }
  void setRadius(double radius);
  void setFriction(double friction);

  /// Fields for what a contact of this kind needs; they follow the body.
  QWidget* makeFields(Kind kind, Settings& settings, Simulation& simulation, QWidget* parent);

 Q_SIGNALS:
  void changed();

 private:
  std::optional<double> radius_;
  double friction_ = 0.5;
};

}  // namespace palpa::gui

#pragma once

#include <QWidget>
#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Options shared by the tools of Simulate mode.
class SimulateOptions : public QObject {
  Q_OBJECT

 public:
  using Kind = bem::ContactTool::Kind;

  /// Radius of contacts, mm; default: a fingertip for the body.
  double radius(const app::DrawnBody& body) const;
  double friction() const { return friction_; }
  void setRadius(double radius);
  void setFriction(double friction);

  /// Fields for a contact of this kind; they follow the body.
  QWidget* makeFields(Kind kind, Settings& settings, Simulation& simulation, QWidget* parent);

 Q_SIGNALS:
  void changed();

 private:
  std::optional<double> radius_;
  double friction_ = 0.5;
};

}  // namespace palpa::gui

#pragma once

#include <QObject>
#include <QTimer>
#include <functional>

#include "app/gui/document/editor.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/widgets/message_bar.h"

namespace palpa::gui {

/// Message over the view that says why there is no model, with buttons for the remedies: after a
/// failure, and when Simulate mode begins without a model.
class FailureNotice : public QObject {
  Q_OBJECT

 public:
  struct Steps {
    /// Activates the tool that paints supports, for a body without a sufficient one.
    std::function<void()> paintSupport;
    /// Asks for the density of the material, which gravity needs.
    std::function<void()> enterDensity;
  };
  FailureNotice(Editor& editor, Simulation& simulation, MessageBar& messages, Steps steps,
                QObject* parent);

 private:
  void follow();
  void show();

  Editor& editor_;
  Simulation& simulation_;
  MessageBar& messages_;
  Steps steps_;
  QTimer delay_;
  QString shown_;
  QStringList buttons_;
};

}  // namespace palpa::gui

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
  /// `paintSupport` activates the tool that paints supports, for a body without a sufficient one.
  FailureNotice(Editor& editor, Simulation& simulation, MessageBar& messages,
                std::function<void()> paintSupport, QObject* parent);

 private:
  void follow();
  void show();

  Editor& editor_;
  Simulation& simulation_;
  MessageBar& messages_;
  std::function<void()> paintSupport_;
  QTimer delay_;
  QString shown_;
  QStringList buttons_;
};

}  // namespace palpa::gui

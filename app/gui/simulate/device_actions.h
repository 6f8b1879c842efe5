#pragma once

#include <QLabel>
#include <QObject>
#include <QTimer>

#include "app/core/device/device_server.h"
#include "app/gui/simulate/simulate_options.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The submenu Simulate > Device: listens for a haptic device, whose tool touches the body, and
/// shows its state in the status bar.
class DeviceActions : public QObject {
  Q_OBJECT

 public:
  DeviceActions(const Workspace& workspace, Simulation& simulation, SimulateOptions& options,
                QObject* parent);

 private:
  void listen(bool on);
  void choose(bem::ContactTool::Kind kind);
  /// The tool with the radius and friction of the mouse's tools.
  bem::ContactTool tool() const;
  void follow();
  void showState();

  Workspace workspace_;
  Simulation& simulation_;
  SimulateOptions& options_;
  QAction* listen_;
  QLabel* label_;
  QTimer refresh_;
  bem::ContactTool::Kind kind_ = bem::ContactTool::Kind::kPush;
  app::DeviceServer::Status status_;  // as shown last
};

}  // namespace palpa::gui

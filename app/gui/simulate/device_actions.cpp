#include "app/gui/simulate/device_actions.h"

#include <QActionGroup>
#include <QSignalBlocker>
#include <QStatusBar>

#include "app/core/device/local_socket.h"
#include "app/gui/workspace/menus.h"

namespace palpa::gui {
namespace {

using Kind = bem::ContactTool::Kind;

constexpr int kRefresh = 500;       // ms
constexpr double kUsualRadius = 6;  // mm, before there is a body

}  // namespace

DeviceActions::DeviceActions(const Workspace& workspace, Simulation& simulation,
                             SimulateOptions& options, QObject* parent)
    : QObject(parent),
      workspace_(workspace),
      simulation_(simulation),
      options_(options),
      label_(new QLabel(&workspace.statusBar)) {
  Menus& menus = workspace.menus;
  menus.simulate->addSeparator();
  QMenu* menu = menus.simulate->addMenu(tr("De&vice"));
  menu->setToolTipsVisible(true);
  listen_ = menus.addToggle(menu,
                            {nullptr,
                             tr("&Listen for a device"),
                             {},
                             tr("Let the program of a haptic device touch the body")},
                            false, this, [this](bool on) { listen(on); });
  menu->addSeparator();
  auto* kinds = new QActionGroup(this);
  for (const auto& [kind, text] : {std::pair{Kind::kPush, tr("&Fingertip at the handle")},
                                   std::pair{Kind::kBall, tr("&Ball at the handle")}})
    kinds->addAction(
        menus.addToggle(menu, {nullptr, text, {}, tr("For devices that connect from now on")},
                        kind == kind_, this, [this, kind = kind](bool on) {
                          if (on) choose(kind);
                        }));
  label_->setObjectName("deviceStatus");
  label_->hide();
  workspace.statusBar.addPermanentWidget(label_);
  label_->hide();  // the status bar shows what it gets
  refresh_.setInterval(kRefresh);
  connect(&refresh_, &QTimer::timeout, this, &DeviceActions::showState);
  connect(&simulation, &Simulation::deviceChanged, this, &DeviceActions::follow);
  for (const auto update : {&Simulation::bodyChanged, &Simulation::waitingChanged})
    connect(&simulation, update, this, [this] { choose(kind_); });
  connect(&options, &SimulateOptions::changed, this, [this] { choose(kind_); });
}

bem::ContactTool DeviceActions::tool() const {
  const auto* drawn = simulation_.drawn();
  return {kind_, drawn ? options_.radius(*drawn) : kUsualRadius, options_.friction()};
}

void DeviceActions::choose(Kind kind) {
  kind_ = kind;
  simulation_.setDeviceTool(tool());
}

void DeviceActions::listen(bool on) {
  if (on) {
    try {
      simulation_.setActive(true);
      simulation_.listen(app::usualDeviceSocket(), tool());
    } catch (const app::DeviceError& error) {
      const QSignalBlocker quiet(listen_);
      listen_->setChecked(false);
      Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
      return;
    }
    status_ = {};
    refresh_.start();
    Q_EMIT workspace_.editor.said(
        tr("Listening for a device at %1")
            .arg(QString::fromStdString(simulation_.device()->path().string())));
  } else {
    simulation_.stopListening();
    refresh_.stop();
  }
  label_->setVisible(on);
  showState();
}

void DeviceActions::follow() {
  if (!simulation_.device()) return;
  const app::DeviceServer::Status now = simulation_.device()->status();
  if (now.isConnected && now.devices != status_.devices)
    Q_EMIT workspace_.editor.said(tr("A device is connected; its tool touches the body"));
  else if (!now.error.empty() && now.error != status_.error)
    Q_EMIT workspace_.editor.refused(QString::fromStdString(now.error));
  else if (now.ended != status_.ended)
    Q_EMIT workspace_.editor.said(tr("The device has left"));
  const std::uint64_t positions = status_.positions;
  status_ = now;
  status_.positions = positions;  // counted by showState()
  showState();
}

void DeviceActions::showState() {
  const app::DeviceServer* device = simulation_.device();
  if (!device) return;
  const app::DeviceServer::Status now = device->status();
  if (!now.isConnected) {
    label_->setText(tr("Waiting for a device"));
  } else {
    const double rate =
        static_cast<double>(now.positions - status_.positions) * (1000.0 / kRefresh);
    label_->setText(rate > 0 ? tr("Device: %L1 Hz").arg(rate, 0, 'f', 0) : tr("Device connected"));
  }
  label_->setToolTip(QString::fromStdString(device->path().string()));
  if (sender() == &refresh_ || !now.isConnected) status_.positions = now.positions;
}

}  // namespace palpa::gui

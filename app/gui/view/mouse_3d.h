#pragma once

#include <Eigen/Core>
#include <QObject>
#include <QSocketNotifier>
#include <QTimer>
#include <memory>

namespace palpa::gui {

/// 3-D mouse by the daemon spacenavd (libspnav). Silent without the daemon; looks for it every few
/// seconds, and again after it has ended. At most one object at a time, as the library has one
/// connection.
class Mouse3d : public QObject {
  Q_OBJECT

 public:
  /// Motion of the cap during some time, in the axes of the screen: x to the right, y up, z towards
  /// the user; 1: fully deflected for one second.
  struct Motion {
    Eigen::Vector3d push = Eigen::Vector3d::Zero();
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< right-handed
  };

  explicit Mouse3d(QObject* parent = nullptr);
  ~Mouse3d() override;

  void setActive(bool active);
  bool isConnected() const { return notifier_ != nullptr; }

 Q_SIGNALS:
  void connectedChanged();
  void moved(const palpa::gui::Mouse3d::Motion& motion);
  /// Buttons count from 0.
  void pressed(int button);

 private:
  void connectToDaemon();
  void disconnectFromDaemon();
  void receive();

  std::unique_ptr<QSocketNotifier> notifier_;
  QTimer search_;
};

}  // namespace palpa::gui

#pragma once

#include <QObject>

namespace palpa::gui {

/// Event filter of the application: the wheel changes combo boxes, number boxes and sliders only
/// while they have the focus. Otherwise it scrolls the panel or dialog that contains them.
class WheelGuard : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpa::gui

#pragma once

#include <QObject>

namespace palpa::gui {

/// Event filter of the application: dialogs open no larger than their screen.
class ScreenFit : public QObject {
 public:
  using QObject::QObject;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace palpa::gui

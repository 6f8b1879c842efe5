#pragma once

#include <QDialog>

namespace palpa::gui {

/// Every shortcut of the window's actions, and what the mouse does in the view.
class KeysDialog : public QDialog {
  Q_OBJECT

 public:
  explicit KeysDialog(QWidget* window);
};

}  // namespace palpa::gui

#pragma once

#include <QDialog>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// List of all shortcuts of the menus and of the keys and mouse buttons of navigation and tools.
class KeysDialog : public QDialog {
  Q_OBJECT

 public:
  explicit KeysDialog(const Workspace& workspace);
};

}  // namespace palpa::gui

#pragma once

#include <QAction>
#include <QObject>

#include "app/gui/workspace.h"

namespace palpa::gui {

/// The Edit and Select menus: history, and what is selected.
class EditActions : public QObject {
  Q_OBJECT

 public:
  explicit EditActions(const Workspace& workspace);

 private:
  void update();

  Workspace workspace_;
  QAction* undo_;
  QAction* redo_;
};

}  // namespace palpa::gui

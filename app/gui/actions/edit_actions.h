#pragma once

#include <QAction>
#include <QObject>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// First entries of the Edit menu: undo and redo, with the names of the steps.
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

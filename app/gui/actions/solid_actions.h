#pragma once

#include <QAction>
#include <QObject>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Entries of the Solid menu that change the whole solid, selected patches or selected edges. Tool
/// tips of disabled entries state the reason.
class SolidActions : public QObject {
  Q_OBJECT

 public:
  explicit SolidActions(const Workspace& workspace);

 private:
  void update();
  void elevate(int direction);
  void setEdges(bool smooth);
  void transform();

  Workspace workspace_;
  QAction* elevateU_;
  QAction* elevateV_;
  QAction* smooth_;
  QAction* sharp_;
};

}  // namespace palpa::gui

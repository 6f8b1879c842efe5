#pragma once

#include <QAction>
#include <QObject>

#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Entries of the Supports and loads menu that choose for the user: a support, and a first touch
/// opposite to the supports. The tool tip of a disabled entry states the reason.
class ProposalActions : public QObject {
  Q_OBJECT

 public:
  explicit ProposalActions(const Workspace& workspace);

 private:
  void update();
  void addSupport();
  void addTouch();

  Workspace workspace_;
  QAction* support_;
  QAction* touch_;
};

}  // namespace palpa::gui

#pragma once

#include <QAction>
#include <QObject>
#include <vector>

#include "app/gui/document/selection_sets.h"
#include "app/gui/tools/point_options.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The Select menu: kind of selection, selections of all, none, neighbours, and named selections.
class SelectActions : public QObject {
  Q_OBJECT

 public:
  SelectActions(const Workspace& workspace, PointOptions& options);

 private:
  void addPicks();
  void addSelections();
  void addSets();
  void fillSets();
  void nameSelection();
  void selectAll();
  void invert();
  void update();

  const Workspace workspace_;
  PointOptions& options_;
  SelectionSets* sets_;
  QAction* name_ = nullptr;
  QMenu* chooseSet_ = nullptr;
  QAction* manageSets_ = nullptr;
  std::vector<QAction*> needSolid_;
  std::vector<QAction*> needPoints_;  // including points of selected patches and edges
};

}  // namespace palpa::gui

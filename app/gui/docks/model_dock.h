#pragma once

#include <QDockWidget>
#include <QTreeView>

#include "app/gui/docks/model_tree.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Panel with the project as a tree. Selection in tree and view are the same.
class ModelDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ModelDock(const Workspace& workspace);
  ~ModelDock() override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void expandGroups();
  void showSelection();
  void chooseRows();
  void showMenu(const QPoint& at);

  Workspace workspace_;
  ModelTree* tree_;
  QTreeView* view_;
  bool isFollowing_ = false;  // showSelection() is selecting rows
};

}  // namespace palpa::gui

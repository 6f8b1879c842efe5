#pragma once

#include <QDockWidget>
#include <QTreeView>

#include "app/gui/docks/model_tree.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The project as a tree. What is chosen in it is what is selected in the view, and back.
class ModelDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ModelDock(const Workspace& workspace);
  ~ModelDock() override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void openUsual();
  void showSelection();
  void chooseRows();
  void showMenu(const QPoint& at);

  Workspace workspace_;
  ModelTree* tree_;
  QTreeView* view_;
  bool isFollowing_ = false;  // the rows are being chosen because the selection changed
};

}  // namespace palpa::gui

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

 Q_SIGNALS:
  /// The user chose a row; its settings are in this section of the Properties panel, or in its
  /// whole page if the name is empty.
  void rowChosen(const QString& section);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void expandGroups();
  void showSelection();
  void chooseRows();
  void announceRow(const QModelIndex& row);
  void showMenu(const QPoint& at);

  Workspace workspace_;
  ModelTree* tree_;
  QTreeView* view_;
  bool isFollowing_ = false;  // showSelection() is selecting rows
};

}  // namespace palpa::gui

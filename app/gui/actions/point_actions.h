#pragma once

#include <QAction>
#include <QObject>
#include <vector>

#include "app/gui/tools/point_options.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Entries of the Edit menu that move selected points by exact numbers.
class PointActions : public QObject {
  Q_OBJECT

 public:
  PointActions(const Workspace& workspace, PointOptions& options);

 private:
  void moveBy();
  void moveTo();
  void moveAlongNormal();
  void align(std::optional<Eigen::Vector3d> normal);
  void update();
  std::set<int> points() const;

  const Workspace workspace_;
  PointOptions& options_;
  std::vector<QAction*> actions_;
};

}  // namespace palpa::gui

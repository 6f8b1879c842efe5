#pragma once

#include <QAction>
#include <QObject>
#include <vector>

#include "app/gui/view/saved_view.h"
#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// The View menu: camera and visible items, stored with the project.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  explicit ViewActions(const Workspace& workspace);

 private:
  void addFits();
  void addDirections();
  void addNavigation();
  void addShadings();
  void addToggles();

  void look(view::StandardView from);
  void lookFromOpposite();
  void orbit(const Eigen::Vector2d& pixels);
  void zoom(double factor);
  void fitSelection();
  void save();
  void restore();

  /// Item of the view that can be hidden.
  struct Part {
    QAction* action;
    bool SavedView::*shown;
  };

  Workspace workspace_;
  std::vector<QAction*> shadings_;  ///< by view::Shading
  std::vector<Part> parts_;
  QAction* parallel_ = nullptr;
};

}  // namespace palpa::gui

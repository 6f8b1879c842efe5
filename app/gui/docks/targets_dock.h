#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <functional>

#include "app/gui/docks/search_panel.h"
#include "app/gui/docks/targets_table.h"
#include "app/gui/document/shape_finder.h"
#include "app/gui/document/touch_values.h"
#include "app/gui/properties/property_page.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Panel "say what it should feel like": the design of the project, the search for a shape and its
/// result.
class TargetsDock : public QDockWidget {
  Q_OBJECT

 public:
  TargetsDock(const Workspace& workspace, ShapeFinder& finder, QWidget* parent);
  ~TargetsDock() override;

  /// Gives the keys to the panel: to its table, or to the button that adds the first target.
  void takeKeys();
  TargetsTable& table() { return *table_; }
  SearchPanel& searchPanel() { return *search_; }

 private:
  QWidget* makeWish();
  void update();
  void updatePages();
  void orderKeys();
  void showObstacle();
  void addTarget();
  void removeTarget();
  void find();
  /// Replaces a page by one that `fill` fills, if its rows are others: `wanted` differs from `key`.
  void updatePage(PropertyPage*& page, QString& key, const QString& wanted,
                  const std::function<void(PropertyPage&)>& fill);

  Workspace workspace_;
  ShapeFinder& finder_;
  TouchValues* values_;
  QStackedWidget* stack_;
  QVBoxLayout* column_ = nullptr;
  TargetsTable* table_ = nullptr;
  QPushButton *add_ = nullptr, *remove_ = nullptr, *find_ = nullptr;
  QLabel* message_ = nullptr;
  PropertyPage *targetPage_ = nullptr, *motionPage_ = nullptr;
  QString targetKey_, motionKey_;
  SearchPanel* search_;
  QTimer soon_, later_;
  QString pointsProblem_;
};

}  // namespace palpa::gui

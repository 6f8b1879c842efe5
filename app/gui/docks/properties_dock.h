#pragma once

#include <QDockWidget>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>

#include "app/gui/properties/property_page.h"
#include "app/gui/document/editor.h"
#include "app/gui/view/tool.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// What is selected as numbers to read and change; above them, what can be set for the active tool.
class PropertiesDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit PropertiesDock(const Workspace& workspace);
  ~PropertiesDock() override;

 private:
  void showTool();
  void showPage();
  void showChange(const modeling::Change& change);
  void removePage();
  /// Makes the page anew when other rows are needed. True when it did.
  bool updatePage();

  Workspace workspace_;
  QScrollArea* scroll_;
  QVBoxLayout* column_;
  const Tool* tool_ = nullptr;
  QWidget* options_ = nullptr;  // of the tool, with its heading
  PropertyPage* page_ = nullptr;
  QString key_;
  QTimer soon_, later_;
};

}  // namespace palpa::gui

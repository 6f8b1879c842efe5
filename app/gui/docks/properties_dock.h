#pragma once

#include <QDockWidget>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>
#include <memory>

#include "app/gui/document/editor.h"
#include "app/gui/properties/property_page.h"
#include "app/gui/view/tool.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Panel with the options of the active tool and, below, the editable numbers of the selection.
class PropertiesDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit PropertiesDock(const Workspace& workspace);
  ~PropertiesDock() override;

  /// Scrolls to a section of the page by its name in PropertyPage::addSection(), or to the top if
  /// there is none.
  void showSection(const QString& name);

 private:
  void showTool();
  void showPage();
  void showChange(const modeling::Change& change);
  void removePage();
  /// Gives the focus to the view if it is inside `part`.
  void returnKeysFrom(const QWidget& part);
  /// Replaces the page if other rows are needed. True if replaced.
  bool updatePage();

  Workspace workspace_;
  QScrollArea* scroll_;
  QVBoxLayout* column_;
  const Tool* tool_ = nullptr;
  QWidget* options_ = nullptr;  // of the tool, with its heading
  PropertyPage* page_ = nullptr;
  QString key_;
  QTimer soon_, later_;
  std::weak_ptr<const app::TouchModel> model_;  // whose facts are shown or soon will be
};

}  // namespace palpa::gui

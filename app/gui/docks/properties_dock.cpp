#include "app/gui/docks/properties_dock.h"

#include <QApplication>
#include <QComboBox>
#include <QFormLayout>
#include <QFrame>
#include <QScrollBar>

#include "app/gui/document/editor.h"
#include "app/gui/properties/pages.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/widgets/scroll_column.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

constexpr int kSoon = 30;    // ms between two refreshes during a drag
constexpr int kLater = 250;  // ms of rest before slow values are computed

/// Object names from the page down to a field, to find the field in another page.
QStringList pathOf(const QWidget* field, const QWidget* page) {
  QStringList path;
  for (const QWidget* each = field; each && each != page; each = each->parentWidget())
    if (!each->objectName().isEmpty()) path.prepend(each->objectName());
  return path;
}

QWidget* findPath(QWidget* page, const QStringList& path) {
  QWidget* found = page;
  for (const QString& name : path)
    if (found) found = found->findChild<QWidget*>(name);
  return found;
}

}  // namespace

PropertiesDock::PropertiesDock(const Workspace& workspace)
    : QDockWidget(tr("Properties"), &workspace.window), workspace_(workspace) {
  setObjectName("properties");
  auto* content = new QWidget(this);
  content->setObjectName("propertiesContent");
  column_ = new QVBoxLayout(content);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(0);
  column_->addStretch();
  scroll_ = scrollColumn(content, this);
  scroll_->setMinimumSize(250, 120);
  setWidget(scroll_);
  soon_.setSingleShot(true);
  soon_.setInterval(kSoon);
  later_.setSingleShot(true);
  later_.setInterval(kLater);
  connect(&soon_, &QTimer::timeout, this, [this] { page_->refresh(); });
  connect(&later_, &QTimer::timeout, this, [this] { page_->refreshSlowValues(); });
  Editor& editor = workspace.editor;
  connect(&editor, &Editor::projectReplaced, this, [this] {
    removePage();
    showPage();
  });
  connect(&editor, &Editor::selectionChanged, this, [this] {
    if (updatePage()) return;
    page_->forgetTyping();
    page_->refresh();
    later_.start();
  });
  connect(&editor, &Editor::projectChanged, this, &PropertiesDock::showChange);
  connect(&editor, &Editor::rebuildChanged, this, [this] {
    // Some values are facts of the model. Its progress changes none of them.
    const std::shared_ptr<const app::TouchModel> model = workspace_.editor.model();
    if (model_.lock() == model) return;
    model_ = model;
    later_.start();
  });
  connect(&workspace.settings, &Settings::changed, this, [this] {
    page_->refresh();
    page_->refreshSlowValues();
  });
  connect(&workspace.tools, &ToolBox::changed, this, &PropertiesDock::showTool);
  showTool();
  showPage();
}

PropertiesDock::~PropertiesDock() {
  page_->retire();
}

void PropertiesDock::showSection(const QString& name) {
  // Later: rows of a new page have no places yet.
  QTimer::singleShot(0, page_, [this, page = page_, name] {
    int top = 0;
    for (const QLabel* heading : page->findChildren<QLabel*>("heading")) {
      if (name.isEmpty() || heading->property("section") != name) continue;
      top = heading->mapTo(scroll_->widget(), QPoint(0, 0)).y();
      break;
    }
    scroll_->verticalScrollBar()->setValue(top);
  });
}

void PropertiesDock::showTool() {
  Tool* active = &workspace_.tools.active();
  if (active == tool_) return;  // only its hint changed
  tool_ = active;
  if (options_) {
    returnKeysFrom(*options_);
    column_->removeWidget(options_);
    options_->hide();
    options_->deleteLater();
    options_ = nullptr;
  }
  auto* section = new QWidget(scroll_->widget());
  QWidget* options = active->makeOptions(section);
  if (!options) {
    delete section;
    return;
  }
  section->setObjectName("toolOptions");
  // Adapt the options to the narrow panel.
  if (auto* form = qobject_cast<QFormLayout*>(options->layout()))
    form->setRowWrapPolicy(QFormLayout::WrapLongRows);
  for (QComboBox* box : options->findChildren<QComboBox*>()) shrinkable(*box);
  leaveLettersToMenus(*options);
  auto* layout = new QVBoxLayout(section);
  layout->setContentsMargins(12, 8, 12, 8);
  auto* heading = new QLabel(workspace_.tools.activeTitle(), section);
  heading->setObjectName("heading");
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  heading->setFont(bold);
  auto* line = new QFrame(section);
  line->setObjectName("rule");
  line->setFixedHeight(1);
  layout->addWidget(heading);
  layout->addWidget(options);
  layout->addWidget(line);
  column_->insertWidget(0, section);
  options_ = section;
}

void PropertiesDock::showPage() {
  page_ = makePage(workspace_);
  page_->setObjectName("page");
  leaveLettersToMenus(*page_);
  page_->refresh();
  column_->insertWidget(options_ ? 1 : 0, page_);
  page_->show();  // now, not with the next event: its fields may be used immediately
  key_ = pageKey(workspace_.editor);
  later_.start();
}

void PropertiesDock::returnKeysFrom(const QWidget& part) {
  // Otherwise Qt would pass the focus to the next field.
  const QWidget* focus = QApplication::focusWidget();
  if (focus && part.isAncestorOf(focus)) workspace_.view.setFocus();
}

void PropertiesDock::removePage() {
  page_->retire();
  returnKeysFrom(*page_);
  column_->removeWidget(page_);
  page_->setObjectName({});
  page_->hide();
  page_->deleteLater();  // the signal may come from one of its fields
}

bool PropertiesDock::updatePage() {
  if (pageKey(workspace_.editor) == key_) return false;
  QWidget* focus = QApplication::focusWidget();
  const bool hadFocus = focus && page_->isAncestorOf(focus);
  const QStringList path = hadFocus ? pathOf(focus, page_) : QStringList();
  scroll_->widget()->setUpdatesEnabled(false);
  removePage();
  showPage();
  scroll_->widget()->setUpdatesEnabled(true);
  if (hadFocus) {
    page_->show();
    QWidget* again = path.isEmpty() ? nullptr : findPath(page_, path);
    if (again) again->setFocus();
  }
  return true;
}

void PropertiesDock::showChange(const modeling::Change& change) {
  if (updatePage()) return;
  later_.start();
  const bool isMotion = !change.movedPoints.empty() && !change.topology;
  if (!isMotion)
    page_->refresh();
  else if (!soon_.isActive())
    soon_.start();
}

}  // namespace palpa::gui

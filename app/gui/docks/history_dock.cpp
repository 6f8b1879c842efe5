#include "app/gui/docks/history_dock.h"

#include "app/gui/base/appearance.h"
#include "app/gui/widgets/faint_text.h"

namespace palpa::gui {
namespace {

constexpr int kDragInterval = 30;  // ms between two updates during a drag

}  // namespace

HistoryDock::HistoryDock(Editor& editor, QWidget* parent)
    : QDockWidget(tr("History"), parent), editor_(editor), list_(new QListWidget(this)) {
  setObjectName("history");
  list_->setObjectName("steps");
  list_->setAccessibleName(tr("Steps of the history"));
  drawFaintText(*list_);
  list_->setUniformItemSizes(true);
  list_->setMinimumHeight(80);
  setWidget(list_);
  soon_.setSingleShot(true);
  soon_.setInterval(kDragInterval);
  connect(&soon_, &QTimer::timeout, this, &HistoryDock::showHistory);
  const auto showSoon = [this] {
    if (!soon_.isActive()) soon_.start();
  };
  connect(&editor, &Editor::fileChanged, this, showSoon);
  const auto go = [this](const QListWidgetItem* item) {
    editor_.goToState(static_cast<std::size_t>(list_->row(item)));
  };
  connect(list_, &QListWidget::itemClicked, this, go);
  connect(list_, &QListWidget::itemActivated, this, go);
  showHistory();
}

void HistoryDock::showHistory() {
  const modeling::Document::History history = editor_.session().document().history();
  const int count = static_cast<int>(history.labels.size());
  const int present = static_cast<int>(history.position);
  while (list_->count() > count) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < count) list_->addItem(QString());
  QPixmap nothing(16, 16);  // aligns the texts
  nothing.fill(Qt::transparent);
  for (int row = 0; row < count; ++row) {
    QListWidgetItem& item = *list_->item(row);
    const bool isSaved = history.saved == static_cast<std::size_t>(row);
    const bool hasFile = !editor_.fileName().isEmpty();
    QString text = QString::fromStdString(history.labels[row]);
    if (text.isEmpty()) text = hasFile ? tr("As opened") : tr("Start");
    // Setting the same text costs a redraw.
    if (item.text() != text) item.setText(text);
    const bool showsSaved = isSaved && hasFile;
    if (item.icon().isNull() || item.data(Qt::UserRole).toBool() != showsSaved) {
      item.setData(Qt::UserRole, showsSaved);
      item.setIcon(showsSaved ? icon("save") : QIcon(nothing));
    }
    QString tip = row > present ? tr("Undone; click to redo") : tr("Click to go back here");
    if (row == present) tip = tr("The project as it is now");
    item.setToolTip(showsSaved ? tip + "\n" + tr("The file contains this state") : tip);
    QFont font = list_->font();
    font.setBold(row == present);
    item.setFont(font);
    item.setData(kFaintTextRole, row > present);
  }
  list_->setCurrentRow(present);
  list_->scrollToItem(list_->item(present));
}

}  // namespace palpa::gui

#include "app/gui/dialogs/keys_dialog.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace palpa::gui {
namespace {

QString plain(QString text) {
  return text.remove('&').remove(QStringLiteral(" …"));
}

void addGroup(QTreeWidget* table, const QString& title,
              const std::vector<std::pair<QString, QString>>& rows) {
  if (rows.empty()) return;
  auto* group = new QTreeWidgetItem(table, {title});
  QFont font = group->font(0);
  font.setBold(true);
  group->setFont(0, font);
  for (const auto& [what, keys] : rows) new QTreeWidgetItem(group, {what, keys});
}

std::vector<std::pair<QString, QString>> shortcutsOf(const QMenu* menu) {
  std::vector<std::pair<QString, QString>> rows;
  for (const QAction* action : menu->actions()) {
    if (const auto* below = action->menu<QMenu*>()) {
      const auto more = shortcutsOf(below);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    QStringList keys;
    for (const QKeySequence& each : action->shortcuts())
      keys << each.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) rows.emplace_back(plain(action->text()), keys.join(", "));
  }
  return rows;
}

}  // namespace

KeysDialog::KeysDialog(QWidget* window) : QDialog(window) {
  setObjectName("keys");
  setWindowTitle(tr("Keyboard and mouse"));
  auto* table = new QTreeWidget(this);
  table->setObjectName("table");
  table->setAccessibleName(windowTitle());
  table->setHeaderLabels({tr("What"), tr("Keys or mouse")});
  addGroup(table, tr("Navigation"),
           {{tr("Turn the view"), tr("Middle button, or Alt + left button")},
            {tr("Move the view"), tr("Right button, Shift + middle button")},
            {tr("Zoom at the pointer"), tr("Wheel")}});
  addGroup(table, tr("Moving, turning and scaling points"),
           {{tr("Begin without a drag"), tr("G, or X, Y, Z")},
            {tr("Hold to an axis or the normal; again: free"), tr("X, Y, Z, N")},
            {tr("Exact length, angle or factor"), tr("Digits, Backspace")},
            {tr("Round"), tr("Ctrl")},
            {tr("Width of the falloff"), tr("Wheel")},
            {tr("Nudge; ten times as far"), tr("Arrow keys; with Shift")},
            {tr("Confirm; take back"), tr("Enter or click; Escape or right button")}});
  addGroup(table, tr("Tools on the surface"),
           {{tr("Brush: smaller, larger; erase"), tr("[ and ]; Ctrl")},
            {tr("Touch along the normal"), tr("Ctrl, or N while dragging")},
            {tr("Knot: other direction; middle of the span"), tr("Tab, or Shift; Ctrl")}});
  addGroup(table, tr("Simulate"),
           {{tr("Touch"), tr("Left button")},
            {tr("Along the normal"), tr("Ctrl, or wheel")},
            {tr("Leave a pin"), tr("Shift while letting go")},
            {tr("Take hold of a pin"), tr("Left button on it")},
            {tr("Let go of a pin; of all"), tr("Double click or Delete; Escape")}});
  if (auto* main = qobject_cast<QMainWindow*>(window))
    for (const QAction* each : main->menuBar()->actions())
      if (const auto* menu = each->menu<QMenu*>())
        addGroup(table, plain(each->text()), shortcutsOf(menu));
  table->expandAll();
  table->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  table->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  table->header()->setStretchLastSection(false);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(table);
  column->addWidget(buttons);
  resize(560, 640);
}

}  // namespace palpa::gui

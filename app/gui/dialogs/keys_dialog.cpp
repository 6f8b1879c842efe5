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
  for (const QAction* action : menu->actions())
    if (!action->shortcut().isEmpty())
      rows.emplace_back(plain(action->text()),
                        action->shortcut().toString(QKeySequence::NativeText));
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

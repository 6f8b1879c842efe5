#include "app/gui/dialogs/keys_dialog.h"

#include <QAction>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QMenu>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "app/gui/workspace/menus.h"
#include "app/gui/workspace/tool_box.h"

namespace palpa::gui {
namespace {

QString plain(QString text) {
  return text.remove('&').remove(QStringLiteral(" …"));
}

void addGroup(QTreeWidget* table, const KeyHelp& help) {
  if (help.rows.empty()) return;
  auto* group = new QTreeWidgetItem(table, {help.title});
  QFont font = group->font(0);
  font.setBold(true);
  group->setFont(0, font);
  for (const KeyHelp::Row& row : help.rows) new QTreeWidgetItem(group, {row.action, row.keys});
}

std::vector<KeyHelp::Row> shortcutsOf(const QMenu* menu) {
  std::vector<KeyHelp::Row> rows;
  for (const QAction* action : menu->actions()) {
    if (const auto* below = action->menu<QMenu*>()) {
      const auto more = shortcutsOf(below);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    QStringList keys;
    for (const QKeySequence& each : action->shortcuts())
      keys << each.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) rows.push_back({plain(action->text()), keys.join(", ")});
  }
  return rows;
}

}  // namespace

KeysDialog::KeysDialog(const Workspace& workspace) : QDialog(&workspace.window) {
  setObjectName("keys");
  setWindowTitle(tr("Keyboard and mouse"));
  auto* table = new QTreeWidget(this);
  table->setObjectName("table");
  table->setAccessibleName(windowTitle());
  table->setHeaderLabels({tr("Action"), tr("Keys or mouse")});
  addGroup(table, ViewportWidget::navigationHelp());
  for (const KeyHelp& group : workspace.tools.keyHelp()) addGroup(table, group);
  for (const QMenu* menu : workspace.menus.all)
    addGroup(table, {plain(menu->title()), shortcutsOf(menu)});
  table->expandAll();
  table->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  table->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  table->header()->setStretchLastSection(false);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(table);
  column->addWidget(buttons);
  resize(760, 640);
}

}  // namespace palpa::gui

#include "app/gui/docks/force_table.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <array>

#include "app/gui/widgets/curve_swatch.h"
#include "app/gui/widgets/faint_text.h"

namespace palpa::gui {
namespace {

constexpr int kColumns = 4;
constexpr int kContactRole = Qt::UserRole, kCurveRole = Qt::UserRole + 1;
constexpr int kMinRows = 3;  // of contacts, with two lines each

app::TouchId contactOf(const QTreeWidgetItem& item) {
  return item.data(0, kContactRole).toULongLong();
}

}  // namespace

ForceTable::ForceTable(Simulation& simulation, QWidget* parent)
    : QTreeWidget(parent), simulation_(simulation) {
  setObjectName("contacts");
  setAccessibleName(tr("Forces of contacts and supports"));
  drawFaintText(*this);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setItemsExpandable(false);
  setIndentation(12);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setHeaderLabels({tr("Contact"), tr("Force"), tr("Deflection"), tr("Stiffness")});
  const std::array<QString, kColumns> tips{
      tr("Contacts, loads and supports; Delete ends the selected contact"),
      tr("Force on the body: its magnitude; the line below has its components"),
      tr("How far the force of this contact alone moves its place: without loads and the forces "
         "of other contacts, which can move it farther"),
      tr("Force divided by deflection")};
  for (int column = 0; column < kColumns; ++column) headerItem()->setToolTip(column, tips[column]);
  // Columns fit the panel; components have a separate line.
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setMinimumSectionSize(20);
  for (int column = 1; column < kColumns; ++column)
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  setIconSize({kCurveSwatch, kCurveSwatch});
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setContextMenuPolicy(Qt::CustomContextMenu);
  setToolTip(tr("Delete ends the selected contact"));
  connect(this, &QWidget::customContextMenuRequested, this, &ForceTable::showMenu);
}

void ForceTable::showRows(const std::vector<Row>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) fillRow(static_cast<int>(i), rows[i]);
  const int count = static_cast<int>(rows.size());
  while (topLevelItemCount() > count) delete takeTopLevelItem(count);
  if (count > 0)
    setMinimumHeight(header()->sizeHint().height() + 2 * frameWidth() +
                     kMinRows * 2 * rowHeight(model()->index(0, 0)));
}

void ForceTable::fillRow(int row, const Row& filled) {
  if (topLevelItemCount() <= row) {
    auto* item = new QTreeWidgetItem(this);
    for (int column = 1; column < kColumns; ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    auto* below = new QTreeWidgetItem(item);
    below->setFlags(Qt::ItemIsEnabled);
    below->setFirstColumnSpanned(true);
    below->setData(0, kFaintTextRole, true);
    item->setExpanded(true);
  }
  QTreeWidgetItem* item = topLevelItem(row);
  const auto set = [](QTreeWidgetItem* of, int column, const QString& text) {
    if (of->text(column) == text) return;
    of->setText(column, text);
    of->setToolTip(column, text);  // for narrow columns
  };
  for (int column = 0; column < filled.cells.size(); ++column)
    set(item, column, filled.cells[column]);
  set(item->child(0), 0, filled.details);
  item->child(0)->setHidden(filled.details.isEmpty());
  if (item->data(0, kCurveRole) != filled.curve) {
    item->setData(0, kCurveRole, filled.curve);
    item->setIcon(0, filled.curve < 0 ? QIcon() : curveSwatch(filled.curve));
  }
  item->setData(0, kContactRole, QVariant::fromValue<qulonglong>(filled.contact));
  item->setFlags(filled.contact ? Qt::ItemIsEnabled | Qt::ItemIsSelectable : Qt::ItemIsEnabled);
}

QString ForceTable::text(int row, int column) const {
  const QTreeWidgetItem* item = topLevelItem(row);
  return item ? item->text(column) : QString();
}

QString ForceTable::details(int row) const {
  const QTreeWidgetItem* item = topLevelItem(row);
  return item && item->childCount() > 0 ? item->child(0)->text(0) : QString();
}

void ForceTable::endSelected() {
  for (const QTreeWidgetItem* item : selectedItems())
    if (const app::TouchId contact = contactOf(*item)) simulation_.end(contact);
  clearSelection();
}

bool ForceTable::event(QEvent* event) {
  const bool isKey = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
  if (!isKey || selectedItems().isEmpty() ||
      !static_cast<QKeyEvent*>(event)->matches(QKeySequence::Delete))
    return QTreeWidget::event(event);
  if (event->type() == QEvent::KeyPress) endSelected();
  event->accept();
  return true;
}

void ForceTable::showMenu(const QPoint& at) {
  QTreeWidgetItem* item = itemAt(at);
  if (item && item->parent()) item = item->parent();
  if (!simulation_.isActive() || !item || !contactOf(*item)) return;
  setCurrentItem(item);
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("&Release"), QKeySequence(QKeySequence::Delete), this,
                  &ForceTable::endSelected);
  menu->addAction(tr("Release &all"), &simulation_, &Simulation::endAll);
  menu->popup(viewport()->mapToGlobal(at));
}

}  // namespace palpa::gui

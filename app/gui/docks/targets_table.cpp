#include "app/gui/docks/targets_table.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QSignalBlocker>
#include <algorithm>

#include "app/gui/document/design_edit.h"
#include "app/gui/document/design_words.h"
#include "app/gui/widgets/curve_swatch.h"

namespace palpa::gui {
namespace {

constexpr int kTargetColumns = 4;

constexpr int kFewTargets = 2, kManyTargets = 5;  // shown without scrolling

}  // namespace

TargetsTable::TargetsTable(Editor& editor, const TouchValues& values, QWidget* parent)
    : QTreeWidget(parent), editor_(editor), values_(values) {
  setObjectName("targets");
  setAccessibleName(tr("Targets: what touches should feel like"));
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setIndentation(0);
  setIconSize({kCurveSwatch, kCurveSwatch});
  setSelectionMode(QAbstractItemView::SingleSelection);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setHeaderLabels({tr("Touch"), tr("Now"), tr("Wanted"), tr("Weight")});
  headerItem()->setToolTip(0, tr("Touch of the project; the colour is the one of its curve"));
  headerItem()->setToolTip(1, tr("What it feels like at present"));
  headerItem()->setToolTip(2, tr("What it should feel like: a stiffness, or a force at a depth"));
  headerItem()->setToolTip(3, tr("Counts if not all targets can be reached"));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setMinimumSectionSize(20);
  for (int column = 1; column < kTargetColumns; ++column)
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  connect(this, &QTreeWidget::itemSelectionChanged, this, &TargetsTable::chosenChanged);
}

void TargetsTable::showTargets() {
  const modeling::Design design = designOf(editor_.project());
  const ShownUnits units = editor_.settings().units();
  const int count = static_cast<int>(design.targets.size());
  const int before = chosen();
  {
    const QSignalBlocker blocker(this);
    while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
    while (topLevelItemCount() < count) {
      auto* item = new QTreeWidgetItem(this);
      item->setIcon(0, curveSwatch(topLevelItemCount() - 1));
      for (int column = 1; column < kTargetColumns; ++column)
        item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
    for (int row = 0; row < count; ++row) {
      const modeling::DesignTarget& target = design.targets[static_cast<std::size_t>(row)];
      const auto now = values_.of(target);
      const QStringList cells{
          QString::fromStdString(target.touch),
          now ? targetNumberText(target.kind, *now, units) : QStringLiteral("–"),
          wantedText(target, units), QString::number(target.weight, 'g', 4)};
      for (int column = 0; column < kTargetColumns; ++column) {
        topLevelItem(row)->setText(column, cells[column]);
        topLevelItem(row)->setToolTip(column, cells[column]);  // for narrow columns
      }
    }
    if (before < 0 && count > 0) setCurrentItem(topLevelItem(0));
  }
  const int rows = std::clamp(count, kFewTargets, kManyTargets);
  const int row =
      count > 0 ? rowHeight(indexFromItem(topLevelItem(0))) : fontMetrics().height() + 6;
  setFixedHeight(header()->sizeHint().height() + 2 * frameWidth() + rows * row + 4);
  if (chosen() != before) Q_EMIT chosenChanged();
}

int TargetsTable::chosen() const {
  const QList<QTreeWidgetItem*> items = selectedItems();
  return items.isEmpty() ? -1 : indexOfTopLevelItem(items.front());
}

void TargetsTable::choose(int target) {
  if (QTreeWidgetItem* item = topLevelItem(target)) setCurrentItem(item);
}

QString TargetsTable::text(int row, int column) const {
  const QTreeWidgetItem* item = topLevelItem(row);
  return item ? item->text(column) : QString();
}

bool TargetsTable::event(QEvent* event) {
  const bool isKey = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
  if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Delete && chosen() >= 0) {
    // Otherwise Delete of the Edit menu would remove what is selected in the view.
    event->accept();
    if (event->type() == QEvent::KeyPress) Q_EMIT removalAsked();
    return true;
  }
  return QTreeWidget::event(event);
}

}  // namespace palpa::gui

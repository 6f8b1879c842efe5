#include "app/gui/docks/comparison_table.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <algorithm>
#include <cmath>

#include "app/gui/widgets/faint_text.h"

namespace palpa::gui {
namespace {

constexpr int kCellDigits = 3;                      // narrow columns; the exported table has all
constexpr double kMinPlain = 1e3, kMaxPlain = 1e7;  // shown without a power of ten
constexpr double kSameShare = 1e-6;   // of a figure: smaller differences are rounding errors
constexpr double kCellNoise = 1e-12;  // of a number in the program's unit: less is a rounding error

/// Unit in which a figure is shown.
Unit unitOfFigure(const app::ComparedFigureInfo& info, const ShownUnits& units) {
  const Unit& length = units.of(Quantity::kLength);
  if (info.figure == app::ComparedFigure::kVolume)
    return {length.symbol + QStringLiteral("³"), std::pow(length.factor, 3)};
  const Unit shown = shownUnit(info.unit, units);
  return shown.symbol.isEmpty() ? Unit{info.unit, 1} : shown;
}

QString cellText(const std::optional<double>& value, const Unit& unit, bool isSigned = false) {
  if (!value) return QStringLiteral("–");
  const double shown = std::abs(*value) < kCellNoise ? 0 : *value / unit.factor;
  const double size = std::abs(shown);
  const bool isPlain = size >= kMinPlain && size < kMaxPlain;  // not 1.78e+04
  return (isSigned && shown > 0 ? "+" : "") +
         (isPlain ? QString::number(shown, 'f', 0) : QString::number(shown, 'g', kCellDigits));
}

/// The difference, and 0 where it is a rounding error of the solution.
std::optional<double> shownDifference(const app::ComparisonRow& row) {
  const auto by = row.difference();
  const bool isNoise = by && std::abs(*by) < kSameShare * std::max(std::abs(*row.values[0]),
                                                                   std::abs(*row.values[1]));
  return isNoise ? 0.0 : by;
}

QString errorTip(const std::optional<double>& error) {
  return error && *error > 0
             ? ComparisonTable::tr("Estimated error %1 %").arg(100 * *error, 0, 'g', 2)
             : QString();
}

QString headingOf(const app::ComparisonRow& row) {
  switch (row.part) {
    case app::ComparisonRow::Part::kContact:
      return QString::fromStdString(row.name);
    case app::ComparisonRow::Part::kSupport:
      return ComparisonTable::tr("Support %1").arg(QString::fromStdString(row.name));
    case app::ComparisonRow::Part::kBody:
      return ComparisonTable::tr("Whole body");
  }
  return {};
}

/// Changes a cell only if its text is another: the table changes many times a second.
void setCell(QTreeWidgetItem& line, int column, const QString& text) {
  if (line.text(column) != text) line.setText(column, text);
}

}  // namespace

ComparisonTable::ComparisonTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("comparisonTable");
  setAccessibleName(tr("Figures of both variants"));
  setColumnCount(kColumns);
  setHeaderLabels({QString(), tr("A"), tr("B"), tr("B − A"), tr("%")});
  headerItem()->setToolTip(kDifference, tr("Grey: smaller than the estimated errors of both"));
  headerItem()->setToolTip(kPercent, tr("Difference over the figure of A"));
  drawFaintText(*this);
  setRootIsDecorated(false);
  setItemsExpandable(false);
  setIndentation(0);
  setUniformRowHeights(true);
  setSelectionMode(QAbstractItemView::SingleSelection);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kLabel, QHeaderView::Stretch);
  header()->setMinimumSectionSize(20);
  for (int column = kA; column < kColumns; ++column)
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

void ComparisonTable::showComparison(const app::Comparison& comparison, const ShownUnits& units) {
  // Lines are reused, since the table changes many times a second during a drag.
  int count = 0;
  QString heading;
  for (const app::ComparisonRow& row : comparison.rows()) {
    if (const QString now = headingOf(row); now != heading) {
      heading = now;
      showHeading(line(count++), heading);
    }
    showRow(line(count++), row, units);
  }
  if (comparison.states[0].state.errorEstimate || comparison.states[1].state.errorEstimate)
    showErrors(line(count++), comparison);
  while (topLevelItemCount() > count) delete takeTopLevelItem(count);
}

QTreeWidgetItem& ComparisonTable::line(int number) {
  if (number == topLevelItemCount()) new QTreeWidgetItem(this);
  return *topLevelItem(number);
}

void ComparisonTable::showHeading(QTreeWidgetItem& line, const QString& heading) {
  setCell(line, kLabel, heading);
  for (int column = kA; column < kColumns; ++column) setCell(line, column, {});
  line.setFlags(Qt::ItemIsEnabled);
  line.setFirstColumnSpanned(true);
  QFont bold = font();
  bold.setBold(true);
  line.setFont(kLabel, bold);
}

void ComparisonTable::makeFigures(QTreeWidgetItem& line) {
  line.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  line.setFirstColumnSpanned(false);
  line.setFont(kLabel, font());
  for (int column = kA; column < kColumns; ++column)
    line.setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

void ComparisonTable::showRow(QTreeWidgetItem& line, const app::ComparisonRow& row,
                              const ShownUnits& units) {
  const app::ComparedFigureInfo& info = app::infoOf(row.figure);
  const Unit unit = unitOfFigure(info, units);
  makeFigures(line);
  setCell(line, kLabel, tr("%1, %2").arg(tr(info.label), unit.symbol));
  setCell(line, kA, cellText(row.values[0], unit));
  setCell(line, kB, cellText(row.values[1], unit));
  const auto difference = shownDifference(row);
  setCell(line, kDifference, cellText(difference, unit, true));
  const auto relative = row.relativeDifference();
  setCell(line, kPercent,
          !relative         ? QString()
          : difference == 0 ? QString("0")
                            : QString::asprintf("%+.1f", 100 * *relative));
  line.setToolTip(kLabel, line.text(kLabel).trimmed());
  line.setToolTip(kA, errorTip(row.errors[0]));
  line.setToolTip(kB, errorTip(row.errors[1]));
  const bool isNoise = row.difference() != 0 && row.isWithinErrors();
  for (const int column : {kDifference, kPercent}) {
    line.setToolTip(column, isNoise ? tr("Smaller than the estimated errors of both") : QString());
    line.setData(column, kFaintTextRole, isNoise);
  }
}

void ComparisonTable::showErrors(QTreeWidgetItem& line, const app::Comparison& comparison) {
  makeFigures(line);
  setCell(line, kLabel, tr("Estimated error, %"));
  line.setToolTip(kLabel, tr("Of forces, stiffness and displacements"));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& error = comparison.states[k].state.errorEstimate;
    setCell(line, kA + static_cast<int>(k), error ? QString::number(100 * *error, 'g', 2) : "–");
  }
  for (const int column : {kDifference, kPercent}) setCell(line, column, {});
}

QString ComparisonTable::text(const QString& heading, const QString& label, int column) const {
  QString current;
  for (int k = 0; k < topLevelItemCount(); ++k) {
    const QTreeWidgetItem& item = *topLevelItem(k);
    if (!(item.flags() & Qt::ItemIsSelectable))
      current = item.text(kLabel);
    else if (current == heading && item.text(kLabel).trimmed().startsWith(label))
      return item.text(column);
  }
  return {};
}

void ComparisonTable::copy() const {
  if (topLevelItemCount() == 0) return;
  QStringList lines{QStringList{QString(), tr("A"), tr("B"), tr("B − A"), tr("%")}.join('\t')};
  for (int k = 0; k < topLevelItemCount(); ++k) {
    QStringList cells;
    for (int column = 0; column < kColumns; ++column)
      cells << topLevelItem(k)->text(column).trimmed();
    lines << cells.join('\t');
  }
  QApplication::clipboard()->setText(lines.join('\n') + '\n');
}

void ComparisonTable::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy))
    copy();
  else
    QTreeWidget::keyPressEvent(event);
}

}  // namespace palpa::gui

#include "app/gui/docks/comparison_dock.h"

#include <QApplication>
#include <QClipboard>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/force_words.h"
#include "app/gui/document/rebuild_words.h"
#include "app/gui/widgets/form_row.h"
#include "base/atomic_file.h"

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
             ? ComparisonDock::tr("Estimated error %1 %").arg(100 * *error, 0, 'g', 2)
             : QString();
}

QString headingOf(const app::ComparisonRow& row) {
  switch (row.part) {
    case app::ComparisonRow::Part::kContact:
      return QString::fromStdString(row.name);
    case app::ComparisonRow::Part::kSupport:
      return ComparisonDock::tr("Support %1").arg(QString::fromStdString(row.name));
    case app::ComparisonRow::Part::kBody:
      return ComparisonDock::tr("Whole body");
  }
  return {};
}

}  // namespace

ComparisonDock::ComparisonDock(const Workspace& workspace, VariantComparison& comparison,
                               ComparisonView& pictures, ComparisonActions& actions,
                               QWidget* parent)
    : QDockWidget(tr("Comparison"), parent),
      workspace_(workspace),
      comparison_(comparison),
      pictures_(pictures),
      actions_(actions),
      stack_(new QStackedWidget(this)) {
  setObjectName("comparison");
  stack_->addWidget(makeStart());
  stack_->addWidget(makeContent());
  setWidget(stack_);
  connect(&comparison, &VariantComparison::changed, this, &ComparisonDock::showState);
  connect(&comparison, &VariantComparison::compared, this, &ComparisonDock::showTable);
  connect(&pictures, &ComparisonView::changed, this, &ComparisonDock::showState);
  connect(&workspace.settings, &Settings::changed, this, &ComparisonDock::showTable);
  connect(&workspace.editor, &Editor::fileChanged, this, &ComparisonDock::showState);
  showState();
}

QWidget* ComparisonDock::makeStart() {
  auto* page = new QWidget(this);
  auto* words = new QLabel(
      tr("Compare the open project with another variant: forces, stiffness, stress and mass under "
         "the same touches, and its shape as a ghost."),
      page);
  words->setWordWrap(true);
  auto* withFile = new QPushButton(icon("compare"), tr("Compare &with …"), page);
  auto* withState = new QPushButton(icon("history"), tr("With the state &before …"), page);
  withFile->setObjectName("compareWithFile");
  withState->setObjectName("compareWithState");
  connect(withFile, &QPushButton::clicked, &actions_, &ComparisonActions::chooseFile);
  connect(withState, &QPushButton::clicked, &actions_, &ComparisonActions::chooseState);
  auto* column = new QVBoxLayout(page);
  column->addWidget(words);
  column->addWidget(withFile, 0, Qt::AlignLeft);
  column->addWidget(withState, 0, Qt::AlignLeft);
  column->addStretch();
  return page;
}

QWidget* ComparisonDock::makeContent() {
  auto* page = new QWidget(this);
  names_ = new QLabel(page);
  names_->setObjectName("comparisonNames");
  names_->setWordWrap(true);
  names_->setTextFormat(Qt::PlainText);
  status_ = new QLabel(page);
  status_->setObjectName("comparisonStatus");
  status_->setWordWrap(true);
  status_->setTextFormat(Qt::PlainText);
  status_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  progress_ = new QProgressBar(page);
  progress_->setObjectName("comparisonProgress");
  progress_->setAccessibleName(tr("Progress of the other variant"));
  progress_->setRange(0, 100);
  const auto makeButton = [page](const QString& text, const char* name, const QString& tip) {
    auto* button = new QPushButton(text, page);
    button->setObjectName(name);
    button->setToolTip(tip);
    return button;
  };
  cancel_ = makeButton(tr("Cancel"), "comparisonCancel", tr("Stop building the other variant"));
  again_ = makeButton(tr("Build again"), "comparisonAgain", tr("Build the other variant again"));
  reload_ = makeButton(tr("&Reload"), "comparisonReload", tr("Read the other variant again"));
  copy_ = makeButton(tr("Cop&y"), "comparisonCopy", tr("Copy the table for a spreadsheet"));
  save_ = makeButton(tr("E&xport …"), "comparisonExport",
                     tr("Write all figures as comma-separated values"));
  end_ = makeButton(tr("E&nd"), "comparisonEnd", tr("End the comparison"));

  shown_ = new QComboBox(page);
  shown_->addItems({tr("A"), tr("B"), tr("Difference B − A")});
  common_ = new QCheckBox(tr("Common co&lours"), page);
  common_->setObjectName("comparisonCommon");
  common_->setToolTip(tr("One range of the colours for the values of both variants"));
  common_->setChecked(pictures_.hasCommonColours());
  deformed_ = new QCheckBox(tr("&Deformed ghost"), page);
  deformed_->setObjectName("comparisonDeformed");
  deformed_->setToolTip(
      tr("Show the other variant under the same touches in Simulate mode, instead of at rest"));
  deformed_->setChecked(pictures_.isDeformed());

  table_ = new QTreeWidget(page);
  table_->setObjectName("comparisonTable");
  table_->setAccessibleName(tr("Figures of both variants"));
  table_->setColumnCount(kColumns);
  table_->setHeaderLabels({QString(), tr("A"), tr("B"), tr("B − A"), tr("%")});
  QTreeWidgetItem* header = table_->headerItem();
  header->setToolTip(kDifference, tr("Grey: smaller than the estimated errors of both"));
  header->setToolTip(kPercent, tr("Difference over the figure of A"));
  table_->setRootIsDecorated(false);
  table_->setItemsExpandable(false);
  table_->setIndentation(0);
  table_->setUniformRowHeights(true);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->installEventFilter(this);
  table_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->header()->setStretchLastSection(false);
  table_->header()->setSectionResizeMode(kLabel, QHeaderView::Stretch);
  table_->header()->setMinimumSectionSize(20);
  for (int column = kA; column < kColumns; ++column)
    header->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);

  auto* build = new QHBoxLayout;
  build->addWidget(progress_, 1);
  build->addWidget(cancel_);
  build->addWidget(again_);
  auto* form = new QFormLayout;
  addFormRow(form, tr("Sho&w"), shown_, "comparisonShown",
             tr("Field on the body: of this project, of the other variant, or the difference at "
                "nearest points"));
  auto* checks = new QHBoxLayout;
  checks->addWidget(common_);
  checks->addWidget(deformed_);
  checks->addStretch();
  auto* buttons = new QHBoxLayout;
  for (QPushButton* button : {copy_, save_, reload_, end_}) {
    button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // four in a narrow panel
    buttons->addWidget(button);
  }
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(6, 6, 6, 6);
  column->addWidget(names_);
  column->addLayout(build);
  column->addWidget(status_);
  column->addLayout(form);
  column->addLayout(checks);
  column->addWidget(table_, 1);
  column->addLayout(buttons);

  connect(shown_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int index) { pictures_.setShown(static_cast<ComparisonView::Shown>(index)); });
  connect(common_, &QCheckBox::toggled, &pictures_, &ComparisonView::setCommonColours);
  connect(deformed_, &QCheckBox::toggled, &pictures_, &ComparisonView::setDeformed);
  connect(cancel_, &QPushButton::clicked, this, [this] { comparison_.cancelBuild(); });
  connect(again_, &QPushButton::clicked, this, [this] { comparison_.buildAgain(); });
  connect(reload_, &QPushButton::clicked, &actions_, &ComparisonActions::reload);
  connect(copy_, &QPushButton::clicked, this, &ComparisonDock::copy);
  connect(save_, &QPushButton::clicked, this, &ComparisonDock::save);
  connect(end_, &QPushButton::clicked, &comparison_, &VariantComparison::end);
  return page;
}

void ComparisonDock::showState() {
  stack_->setCurrentIndex(comparison_.isActive() ? 1 : 0);
  if (!comparison_.isActive()) {
    table_->clear();
    return;
  }
  names_->setText(tr("A: %1, as it is now").arg(comparison_.nameOfA()) + "\n" +
                  tr("B: %1").arg(comparison_.nameOfB()));
  names_->setToolTip(comparison_.file());
  const app::RebuildStatus status = comparison_.otherStatus();
  using State = app::RebuildStatus::State;
  const bool isBuilding = status.state == State::kBuilding;
  progress_->setVisible(isBuilding);
  cancel_->setVisible(isBuilding);
  progress_->setValue(static_cast<int>(std::lround(100 * status.progress)));
  again_->setVisible(status.state == State::kFailed || status.state == State::kCancelled);
  reload_->setVisible(!comparison_.file().isEmpty());
  showStatus();
}

QString ComparisonDock::touchesText() const {
  const auto result = comparison_.result();
  if (!result || !result->comparison) return {};
  QStringList words;
  const app::Comparison& comparison = *result->comparison;
  if (comparison.touches.empty())
    words << tr("Nothing is touched: loads act alone. Touch the body in Simulate mode (F5).");
  else if (result->isOfView)
    words << tr("Touches: the contacts in the view.");
  else
    words << tr("Touches: the touches of the project.");
  for (const app::CarriedTouch& carried : comparison.carried) {
    const QString name = QString::fromStdString(carried.touch.name);
    const QString distance =
        shown(carried.distance, Quantity::kLength, workspace_.settings.units(), 3);
    if (carried.isTurned)
      words << tr("%1: the nearest point of B, %2 away, faces away from the place on A.")
                   .arg(name, distance);
    else if (carried.distance > result->surfaces->reach())
      words << tr("%1: the nearest point of B is %2 away from the place on A.").arg(name, distance);
  }
  return words.join("\n");
}

QString ComparisonDock::statusText() const {
  using State = app::RebuildStatus::State;
  const app::RebuildStatus status = comparison_.otherStatus();
  QStringList words;
  if (status.state == State::kBuilding) words << tr("B is being built.");
  if (status.state == State::kCancelled)
    words << tr("Building B was stopped. Build it again, or end the comparison.");
  if (status.state == State::kFailed)
    words << tr("B cannot be built: %1").arg(QString::fromStdString(status.error));
  if (!comparison_.fileNotice().isEmpty()) words << comparison_.fileNotice();
  const auto result = comparison_.result();
  if (result && !result->drawnA) words << waitingText(workspace_.editor.rebuildStatus());
  if (result && !result->problem.isEmpty())
    words << tr("The touches cannot be compared. %1").arg(result->problem);
  words << touchesText() << pictures_.note();
  words.removeAll(QString());
  return words.join("\n");
}

void ComparisonDock::showStatus() {
  const QString text = statusText();
  if (status_->text() != text) status_->setText(text);
  status_->setVisible(!text.isEmpty());
}

void ComparisonDock::showTable() {
  const auto result = comparison_.result();
  const bool hasRows = result && result->comparison;
  copy_->setEnabled(hasRows);
  save_->setEnabled(hasRows);
  if (comparison_.isActive()) showStatus();
  if (!hasRows) {
    table_->clear();
    return;
  }
  const ShownUnits units = workspace_.settings.units();
  int line = 0;
  const auto set = [](QTreeWidgetItem& item, int column, const QString& text) {
    if (item.text(column) != text) item.setText(column, text);
  };
  // Lines are kept: during a drag the table changes many times a second.
  const auto next = [this, &line] {
    if (line == table_->topLevelItemCount()) new QTreeWidgetItem(table_);
    return table_->topLevelItem(line++);
  };
  QString heading;
  for (const app::ComparisonRow& row : result->comparison->rows()) {
    if (const QString now = headingOf(row); now != heading) {
      heading = now;
      QTreeWidgetItem& item = *next();
      set(item, kLabel, heading);
      for (int column = kA; column < kColumns; ++column) set(item, column, {});
      item.setFlags(Qt::ItemIsEnabled);
      item.setFirstColumnSpanned(true);
      QFont font = table_->font();
      font.setBold(true);
      item.setFont(kLabel, font);
    }
    const app::ComparedFigureInfo& info = app::infoOf(row.figure);
    const Unit unit = unitOfFigure(info, units);
    QTreeWidgetItem& item = *next();
    item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item.setFirstColumnSpanned(false);
    item.setFont(kLabel, table_->font());
    set(item, kLabel, tr("%1, %2").arg(tr(info.label), unit.symbol));
    set(item, kA, cellText(row.values[0], unit));
    set(item, kB, cellText(row.values[1], unit));
    const auto difference = shownDifference(row);
    set(item, kDifference, cellText(difference, unit, true));
    const auto relative = row.relativeDifference();
    set(item, kPercent,
        !relative         ? QString()
        : difference == 0 ? QString("0")
                          : QString::asprintf("%+.1f", 100 * *relative));
    item.setToolTip(kLabel, item.text(kLabel).trimmed());
    item.setToolTip(kA, errorTip(row.errors[0]));
    item.setToolTip(kB, errorTip(row.errors[1]));
    const bool isNoise = row.difference() != 0 && row.isWithinErrors();
    for (int column = kA; column < kColumns; ++column)
      item.setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    for (const int column : {kDifference, kPercent}) {
      item.setToolTip(column,
                      isNoise ? tr("Smaller than the estimated errors of both") : QString());
      item.setForeground(column,
                         palette().color(isNoise ? QPalette::PlaceholderText : QPalette::Text));
    }
  }
  const auto& states = result->comparison->states;
  if (states[0].state.errorEstimate || states[1].state.errorEstimate) {
    QTreeWidgetItem& item = *next();
    item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    item.setFirstColumnSpanned(false);
    item.setFont(kLabel, table_->font());
    set(item, kLabel, tr("Estimated error, %"));
    item.setToolTip(kLabel, tr("Of forces, stiffness and displacements"));
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& error = states[k].state.errorEstimate;
      set(item, kA + static_cast<int>(k), error ? QString::number(100 * *error, 'g', 2) : "–");
      item.setTextAlignment(kA + static_cast<int>(k), Qt::AlignRight | Qt::AlignVCenter);
    }
    for (const int column : {kDifference, kPercent}) set(item, column, {});
  }
  while (table_->topLevelItemCount() > line) delete table_->takeTopLevelItem(line);
}

QString ComparisonDock::text(const QString& heading, const QString& label, int column) const {
  QString current;
  for (int k = 0; k < table_->topLevelItemCount(); ++k) {
    const QTreeWidgetItem& item = *table_->topLevelItem(k);
    if (!(item.flags() & Qt::ItemIsSelectable))
      current = item.text(kLabel);
    else if (current == heading && item.text(kLabel).trimmed().startsWith(label))
      return item.text(column);
  }
  return {};
}

void ComparisonDock::copy() const {
  if (table_->topLevelItemCount() == 0) return;
  QStringList lines{QStringList{QString(), tr("A"), tr("B"), tr("B − A"), tr("%")}.join('\t')};
  for (int k = 0; k < table_->topLevelItemCount(); ++k) {
    QStringList cells;
    for (int column = 0; column < kColumns; ++column)
      cells << table_->topLevelItem(k)->text(column).trimmed();
    lines << cells.join('\t');
  }
  QApplication::clipboard()->setText(lines.join('\n') + '\n');
}

void ComparisonDock::save() {
  // The dialog runs the event loop: the comparison may end meanwhile.
  const auto result = comparison_.result();
  if (!result || !result->comparison) return;
  const QString file =
      askFileToWrite(workspace_, tr("Export the comparison"), tr("Tables (*.csv)"), ".csv");
  if (file.isEmpty()) return;
  std::ostringstream text;
  app::writeComparison(result->comparison->rows(), text);
  try {
    replaceFile(text.str(), file.toStdString());
    Q_EMIT workspace_.editor.said(tr("Comparison exported to %1").arg(file));
  } catch (const Error& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

bool ComparisonDock::eventFilter(QObject* watched, QEvent* event) {
  if (watched == table_ && event->type() == QEvent::KeyPress &&
      static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) {
    copy();
    return true;
  }
  return QDockWidget::eventFilter(watched, event);
}

}  // namespace palpa::gui

#include "app/gui/docks/comparison_dock.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>
#include <sstream>

#include "app/gui/base/appearance.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/rebuild_words.h"
#include "app/gui/widgets/form_row.h"
#include "base/atomic_file.h"

namespace palpa::gui {

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
  export_ = makeButton(tr("E&xport …"), "comparisonExport",
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

  table_ = new ComparisonTable(page);

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
  for (QPushButton* button : {copy_, export_, reload_, end_}) {
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
  connect(copy_, &QPushButton::clicked, table_, &ComparisonTable::copy);
  connect(export_, &QPushButton::clicked, this, &ComparisonDock::exportTable);
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
  export_->setEnabled(hasRows);
  showState();  // with the buttons: a build may have ended since
  if (!hasRows) {
    table_->clear();
    return;
  }
  table_->showComparison(*result->comparison, workspace_.settings.units());
}

void ComparisonDock::exportTable() {
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

}  // namespace palpa::gui

#include "app/gui/docks/rebuild_dock.h"

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/core/model/build_phase.h"
#include "app/core/system/memory.h"
#include "app/gui/base/appearance.h"
#include "app/gui/docks/accuracy_panel.h"
#include "app/gui/document/accuracy_words.h"
#include "app/gui/document/rebuild_words.h"
#include "app/gui/document/remedies.h"
#include "app/gui/widgets/scroll_column.h"

namespace palpa::gui {
namespace {

using State = app::RebuildStatus::State;

QString seconds(double value) {
  return RebuildDock::tr("%L1 s").arg(value, 0, 'f', value < 0.1 ? 3 : 2);
}

/// Warnings of a model that was built.
QString warningText(const app::BuildReport& report) {
  QStringList lines;
  if (!report.notice.empty()) lines << QString::fromStdString(report.notice);
  if (!report.warnings->empty()) {
    lines << QString::fromStdString(report.warnings->front().message);
    if (const std::size_t more = report.warnings->size() - 1; more == 1)
      lines << RebuildDock::tr("one more warning is marked in the view");
    else if (more > 1)
      lines << RebuildDock::tr("%1 more warnings are marked in the view").arg(more);
  }
  for (QString& line : lines) line[0] = line[0].toUpper();
  return lines.join(". ") + (lines.isEmpty() ? "" : ".");
}

/// Note about a model that is an incremental update.
QString updateText(const app::RebuildStatus& status) {
  return RebuildDock::tr(
             "The present shape can be touched: its equations are solved with the help of an "
             "earlier shape, exact to %L1.")
      .arg(*status.residual, 0, 'e', 0);
}

}  // namespace

RebuildDock::RebuildDock(Editor& editor, QWidget* parent)
    : QDockWidget(tr("Rebuild"), parent), editor_(editor) {
  setObjectName("rebuild");
  auto* content = new QWidget(this);
  auto* layout = new QVBoxLayout(content);
  state_ = new QLabel(content);
  state_->setObjectName("rebuildState");
  QFont bold = state_->font();
  bold.setBold(true);
  state_->setFont(bold);
  details_ = new QLabel(content);
  details_->setObjectName("rebuildDetails");
  details_->setWordWrap(true);
  details_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  details_->setTextFormat(Qt::PlainText);
  progress_ = new QProgressBar(content);
  progress_->setObjectName("rebuildProgress");
  progress_->setAccessibleName(tr("Progress of the rebuild"));
  progress_->setRange(0, 100);
  stop_ = new QPushButton(icon("cancel"), tr("Stop"), content);
  stop_->setObjectName("stopRebuild");
  stop_->setToolTip(tr("Stop the present build; the last good model stays"));
  again_ = new QPushButton(icon("redo"), tr("Build again"), content);
  again_->setObjectName("buildAgain");
  again_->setToolTip(tr("Build the model of the present shape"));
  auto* stages = new QGridLayout;
  auto* facts = new QGridLayout;
  makeStages(*stages);
  auto* accuracy = new QGridLayout;
  makeAccuracy(*accuracy);
  modelTitle_ = new QLabel(content);
  modelTitle_->setObjectName("modelTitle");
  modelTitle_->setFont(bold);
  makeFacts(*facts);
  layout->addWidget(state_);
  remedies_ = new QWidget(content);
  new QVBoxLayout(remedies_);
  remedies_->layout()->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(details_);
  layout->addWidget(remedies_);
  layout->addWidget(progress_);
  layout->addWidget(stop_, 0, Qt::AlignLeft);
  layout->addWidget(again_, 0, Qt::AlignLeft);
  layout->addLayout(stages);
  layout->addSpacing(8);
  layout->addLayout(accuracy);
  layout->addWidget(new AccuracyPanel(editor, "rebuildAccuracy", false, content));
  layout->addSpacing(8);
  layout->addWidget(modelTitle_);
  layout->addLayout(facts);
  layout->addStretch();
  setWidget(scrollColumn(content, this));
  connect(stop_, &QPushButton::clicked, &editor, &Editor::cancelRebuild);
  connect(again_, &QPushButton::clicked, &editor, &Editor::rebuildAgain);
  connect(&editor, &Editor::rebuildChanged, this, &RebuildDock::showStatus);
  showStatus();
}

RebuildDock::Row RebuildDock::addRow(QGridLayout& grid, const QString& name,
                                     const QString& objectName) {
  const int row = grid.rowCount();
  grid.setVerticalSpacing(2);
  grid.setColumnStretch(0, 1);
  Row result{{}, new QLabel(name, this), new QLabel(this)};
  result.value->setObjectName(objectName);
  result.value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  grid.addWidget(result.name, row, 0);
  grid.addWidget(result.value, row, 1);
  return result;
}

void RebuildDock::makeStages(QGridLayout& grid) {
  for (const app::BuildPhase& phase : app::kBuildPhases) {
    const QString name = QString::fromStdString(std::string(nameOf(phase.phase)));
    stages_.push_back(addRow(grid, tr(phase.label), "stage-" + name));
    stages_.back().phase = phase.phase;
  }
  total_ = addRow(grid, tr("Total"), "stage-total");
}

void RebuildDock::makeAccuracy(QGridLayout& grid) {
  requested_ = addRow(grid, tr("Requested accuracy"), "modelRequested");
  error_ = addRow(grid, tr("Estimated accuracy"), "modelError");
  const QString error = tr(
      "Relative error of the force under a fingertip away from supports, estimated from how well "
      "the equations hold between the points where they are demanded");
  const QString requested =
      tr("Relative error of displacements and forces that the mesh should have; set in Properties "
         "of Mesh");
  for (QLabel* label : {requested_.name, requested_.value}) label->setToolTip(requested);
  for (QLabel* label : {error_.name, error_.value}) label->setToolTip(error);
}

void RebuildDock::makeFacts(QGridLayout& grid) {
  coefficients_ = addRow(grid, tr("Spline coefficients"), "modelCoefficients");
  elements_ = addRow(grid, tr("Spline elements"), "modelElements");
  nodes_ = addRow(grid, tr("Nodes"), "modelNodes");
  triangles_ = addRow(grid, tr("Triangles"), "modelTriangles");
  angle_ = addRow(grid, tr("Smallest angle"), "modelAngle");
  memory_ = addRow(grid, tr("Memory"), "modelMemory");
  condition_ = addRow(grid, tr("Condition number"), "modelCondition");
  balance_ = addRow(grid, tr("Balance of forces"), "modelBalance");
  const QString condition =
      tr("How much rounding errors can grow in the solution, at most; estimated");
  const QString balance =
      tr("Sum of all forces at rest, over the largest of them: an indicator of the error");
  for (QLabel* label : {condition_.name, condition_.value}) label->setToolTip(condition);
  for (QLabel* label : {balance_.name, balance_.value}) label->setToolTip(balance);
}

void RebuildDock::showStatus() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  showState(status);
  showStages(status);
  showFacts(status);
}

void RebuildDock::showState(const app::RebuildStatus& status) {
  const bool isBuilding = status.state == State::kBuilding;
  state_->setText(!isBuilding        ? rebuildText(status)
                  : isUpdate(status) ? tr("Completing the model")
                                     : tr("Building the model"));
  QString details;
  if (status.state == State::kFailed) details = failureText(status);
  if (status.state == State::kCancelled)
    details = tr("The present shape has no model. The next edit builds one, too.");
  if (isUpdate(status) && status.state != State::kFailed) details = updateText(status);
  if (status.state == State::kUpToDate) details = warningText(editor_.model()->report());
  details_->setText(details);
  details_->setVisible(!details.isEmpty());
  showRemedies();
  progress_->setVisible(isBuilding);
  progress_->setValue(percent(status.progress));
  // A hidden button passes its focus to the button that replaces it.
  const bool hadFocus = stop_->hasFocus() || again_->hasFocus();
  const bool canRepeat = status.state == State::kFailed || status.state == State::kCancelled;
  stop_->setVisible(isBuilding);
  again_->setVisible(canRepeat);
  if (hadFocus && isBuilding) stop_->setFocus();
  if (hadFocus && canRepeat) again_->setFocus();
}

void RebuildDock::showRemedies() {
  const std::vector<Remedy> remedies = remediesOf(editor_);
  QStringList texts;
  for (const Remedy& remedy : remedies) texts << remedy.text + remedy.tip;
  remedies_->setVisible(!remedies.empty());
  if (remedies_->property("texts").toStringList() == texts) return;  // keeps the focus
  remedies_->setProperty("texts", texts);
  for (QPushButton* button : remedies_->findChildren<QPushButton*>()) delete button;
  for (const Remedy& remedy : remedies) {
    auto* button = new QPushButton(remedy.text, remedies_);
    button->setToolTip(remedy.tip);
    // Later: the edit replaces the buttons.
    connect(button, &QPushButton::clicked, this, remedy.apply, Qt::QueuedConnection);
    remedies_->layout()->addWidget(button);
    remedies_->layout()->setAlignment(button, Qt::AlignLeft);
  }
}

void RebuildDock::showStages(const app::RebuildStatus& status) {
  const auto find = [&](Phase phase) {
    return std::find_if(status.stages.begin(), status.stages.end(),
                        [&](const app::BuildStage& stage) { return stage.phase == phase; });
  };
  const auto wasReached = [&](Phase phase) { return find(phase) != status.stages.end(); };
  // Factorised model from the disk or of the previous shape.
  const bool isKnown =
      (wasReached(Phase::kRead) || wasReached(Phase::kSolve)) && !wasReached(Phase::kAssemble);
  double total = 0;
  for (const Row& row : stages_) {
    const auto stage = find(row.phase);
    const bool wasBegun = stage != status.stages.end();
    const bool isShown = row.phase == Phase::kRead || row.phase == Phase::kUpdate ? wasBegun
                         : row.phase == Phase::kAssemble || row.phase == Phase::kFactorise
                             ? !isKnown
                             : true;
    row.name->setVisible(isShown);
    row.value->setVisible(isShown);
    row.name->setEnabled(wasBegun);
    if (wasBegun) total += stage->seconds;
    const bool runs = wasBegun && status.state == State::kBuilding && status.phase == row.phase;
    row.value->setText(!wasBegun ? QString("–")
                       : runs    ? tr("%1 %").arg(percent(stage->fraction))
                       : stage->fraction < 1 ||
                               (status.state == State::kFailed && &*stage == &status.stages.back())
                           ? seconds(stage->seconds) + " ✗"
                           : seconds(stage->seconds) + " ✓");
  }
  total_.value->setText(status.stages.empty() ? QString("–") : seconds(total) + "   ");
}

void RebuildDock::showFacts(const app::RebuildStatus& status) {
  const auto model = editor_.model();
  modelTitle_->setText(!model                                    ? tr("No model yet")
                       : status.modelRevision != status.revision ? tr("Model of the previous shape")
                                                                 : tr("Model"));
  for (const Row& row :
       {nodes_, triangles_, angle_, memory_, condition_, balance_, requested_, error_}) {
    row.name->setVisible(model != nullptr);
    row.value->setVisible(model != nullptr);
  }
  for (const Row& row : {coefficients_, elements_}) {
    row.name->setVisible(model && model->setup().splines);
    row.value->setVisible(model && model->setup().splines);
  }
  if (!model) return;
  const app::BuildReport& report = model->report();
  nodes_.value->setText(tr("%L1").arg(report.nodes));
  triangles_.value->setText(tr("%L1").arg(report.triangles));
  angle_.value->setText(tr("%L1°").arg(report.quality.smallestAngle, 0, 'f', 1));
  memory_.value->setText(QString::fromStdString(app::formatBytes(report.memory)));
  condition_.value->setText(status.condition > 0 ? tr("%L1").arg(status.condition, 0, 'e', 1)
                                                 : QString("…"));
  coefficients_.value->setText(tr("%L1").arg(model->setup().discretisation->displacementCount()));
  elements_.value->setText(tr("%L1").arg(model->setup().discretisation->elementCount()));
  requested_.value->setText(percentText(editor_.project().mesh.accuracy));
  error_.value->setText(status.touchError > 0 ? tr("about %1").arg(percentText(status.touchError))
                                              : QString("…"));
  const app::TouchState& rest = model->rest();
  balance_.value->setText(rest.relativeBalance > 0 ? percentText(rest.relativeBalance)
                                                   : tr("no forces"));
}

}  // namespace palpa::gui

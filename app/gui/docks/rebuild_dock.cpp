#include "app/gui/docks/rebuild_dock.h"

#include <QVBoxLayout>

#include "app/core/memory.h"
#include "app/gui/appearance.h"

namespace palpa::gui {
namespace {

using State = app::RebuildStatus::State;

/// Progress over all phases, in per cent: each phase has a share that fits bodies of some thousand
/// nodes.
int totalPercent(const app::RebuildStatus& status) {
  struct Share {
    const char* phase;
    double begin, end;
  };
  for (const auto& [phase, begin, end] : {Share{"mesh", 0, 5}, Share{"assemble", 5, 55},
                                          Share{"factorise", 55, 95}, Share{"solve", 95, 100}})
    if (status.phase == phase) return static_cast<int>(begin + status.fraction * (end - begin));
  return 0;
}

}  // namespace

QString rebuildText(const app::RebuildStatus& status) {
  switch (status.state) {
    case State::kEmpty:
      return RebuildDock::tr("No model");
    case State::kBuilding:
      return status.phase.empty() ? RebuildDock::tr("Waiting …")
                                  : RebuildDock::tr("Building the model: %1")
                                        .arg(QString::fromStdString(status.phase));
    case State::kUpToDate:
      return RebuildDock::tr("Up to date");
    case State::kFailed:
      return RebuildDock::tr("Cannot be built");
    case State::kCancelled:
      return RebuildDock::tr("Stopped");
  }
  return {};
}

RebuildDock::RebuildDock(Editor& editor, QWidget* parent)
    : QDockWidget(tr("Rebuild"), parent), editor_(editor) {
  setObjectName("rebuild");
  auto* content = new QWidget(this);
  auto* layout = new QVBoxLayout(content);
  state_ = new QLabel(content);
  state_->setWordWrap(true);
  progress_ = new QProgressBar(content);
  progress_->setRange(0, 100);
  cancel_ = new QPushButton(icon("cancel"), tr("Stop"), content);
  cancel_->setToolTip(tr("Stop the present build; the last good model stays"));
  facts_ = new QLabel(content);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  layout->addWidget(state_);
  layout->addWidget(progress_);
  layout->addWidget(cancel_, 0, Qt::AlignLeft);
  layout->addWidget(facts_);
  layout->addStretch();
  setWidget(content);
  connect(cancel_, &QPushButton::clicked, &editor, &Editor::cancelRebuild);
  connect(&editor, &Editor::rebuildChanged, this, &RebuildDock::showStatus);
  showStatus();
}

void RebuildDock::showStatus() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  const bool isBuilding = status.state == State::kBuilding;
  state_->setText(status.state == State::kFailed
                      ? tr("Cannot be built: %1").arg(QString::fromStdString(status.error))
                      : rebuildText(status));
  progress_->setVisible(isBuilding);
  progress_->setValue(totalPercent(status));
  cancel_->setVisible(isBuilding);
  const auto model = editor_.model();
  if (!model) {
    facts_->clear();
    return;
  }
  const app::BuildReport& report = model->report();
  const double seconds =
      report.meshSeconds + report.assembleSeconds + report.factoriseSeconds + report.solveSeconds;
  QString text = tr("%L1 nodes, %L2 triangles\nsmallest angle %3°\n%4\nbuilt in %5 s")
                     .arg(report.nodes)
                     .arg(report.triangles)
                     .arg(report.quality.smallestAngle, 0, 'f', 1)
                     .arg(QString::fromStdString(app::formatBytes(report.memory)))
                     .arg(seconds, 0, 'f', 2);
  if (status.modelRevision != status.revision) text += tr("\n(of the previous shape)");
  facts_->setText(text);
}

}  // namespace palpa::gui

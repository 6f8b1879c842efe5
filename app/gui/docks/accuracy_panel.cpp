#include "app/gui/docks/accuracy_panel.h"

#include <QVBoxLayout>

#include "app/gui/document/accuracy_words.h"

namespace palpa::gui {

AccuracyPanel::AccuracyPanel(Editor& editor, const QString& name, bool showsNumbers,
                             QWidget* parent)
    : QWidget(parent),
      editor_(editor),
      showsNumbers_(showsNumbers),
      text_(new QLabel(this)),
      refine_(new QPushButton(tr("Refine to reach it"), this)) {
  text_->setObjectName(name + "Text");
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setToolTip(
      tr("Relative error of the force under a fingertip away from supports, estimated from how "
         "well the equations hold between the points where they are demanded"));
  refine_->setObjectName(name + "Refine");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(text_);
  column->addWidget(refine_, 0, Qt::AlignLeft);
  connect(refine_, &QPushButton::clicked, this, &AccuracyPanel::refine);
  connect(&editor, &Editor::rebuildChanged, this, &AccuracyPanel::showStatus);
  showStatus();
}

void AccuracyPanel::setNote(const QString& note) {
  if (note == note_) return;
  note_ = note;
  showStatus();
}

void AccuracyPanel::showStatus() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  const bool hasModel = status.modelRevision > 0;
  setVisible(hasModel);
  if (!hasModel) return;
  QStringList lines;
  if (showsNumbers_) lines << accuracyText(status, editor_.project().mesh.accuracy);
  if (const QString reason = accuracyReason(status); !reason.isEmpty()) lines << reason;
  if (!note_.isEmpty()) lines << note_;
  text_->setText(lines.join('\n'));
  text_->setVisible(!lines.isEmpty());
  refine_->setVisible(!showsNumbers_ || !accuracyReason(status).isEmpty());
  refine_->setEnabled(canRefine(status));
  refine_->setToolTip(refineTip(status));
}

void AccuracyPanel::refine() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  if (canRefine(status)) editor_.perform(modeling::SetMesh{*status.accuracy->mesh});
}

}  // namespace palpa::gui

#include "app/gui/base/progress_dialog.h"

#include <QDialogButtonBox>
#include <QVBoxLayout>
#include <cmath>

namespace palpa::gui {

ProgressDialog::ProgressDialog(const QString& title, QWidget* parent)
    : QDialog(parent), phase_(new QLabel(this)), bar_(new QProgressBar(this)) {
  setObjectName("progress");
  setWindowTitle(title);
  setWindowModality(Qt::WindowModal);
  setMinimumWidth(380);
  auto* what = new QLabel(title, this);
  what->setWordWrap(true);
  phase_->setObjectName("phase");
  bar_->setRange(0, 0);  // until the job reports a fraction
  auto* buttons = new QDialogButtonBox(this);
  cancel_ = buttons->addButton(QDialogButtonBox::Cancel);
  cancel_->setObjectName("cancel");
  connect(buttons, &QDialogButtonBox::rejected, this, &ProgressDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(what);
  column->addWidget(bar_);
  column->addWidget(phase_);
  column->addWidget(buttons);
}

void ProgressDialog::showProgress(const QString& phase, double fraction, bool isStopping) {
  cancel_->setEnabled(!isStopping);
  if (isStopping) {
    phase_->setText(tr("Stopping as soon as this step is done …"));
    bar_->setRange(0, 0);
  } else if (!phase.isEmpty()) {
    phase_->setText(phase.left(1).toUpper() + phase.mid(1));
    bar_->setRange(0, 100);
    bar_->setValue(static_cast<int>(std::lround(100 * fraction)));
  }
}

void ProgressDialog::reject() {
  cancel_->setEnabled(false);
  Q_EMIT rejected();
}

}  // namespace palpa::gui

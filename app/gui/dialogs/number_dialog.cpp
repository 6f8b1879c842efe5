#include "app/gui/dialogs/number_dialog.h"

#include <QDialogButtonBox>
#include <QVBoxLayout>

namespace palpa::gui {

NumberDialog::NumberDialog(const QString& title, const QString& text, const Settings& settings,
                           QWidget* parent)
    : QDialog(parent), settings_(settings), form_(new QFormLayout), problem_(new QLabel(this)) {
  setWindowTitle(title);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(10);
  auto* sentence = new QLabel(text, this);
  sentence->setWordWrap(true);
  layout->addWidget(sentence);
  layout->addLayout(form_);
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  layout->addWidget(problem_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, &NumberDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &NumberDialog::reject);
  layout->addWidget(buttons);
  setMinimumWidth(380);
}

VectorEdit& NumberDialog::addVector(const QString& label, const Eigen::Vector3d& value) {
  auto* field = new VectorEdit(Quantity::kLength, settings_, this);
  field->setValue(value);
  form_->addRow(label, field);
  if (form_->rowCount() == 1) field->component(0).setFocus();
  return *field;
}

QuantityEdit& NumberDialog::addLength(const QString& label, double value) {
  auto* field = new QuantityEdit(Quantity::kLength, settings_, this);
  field->setValue(value);
  form_->addRow(label, field);
  if (form_->rowCount() == 1) field->setFocus();
  return *field;
}

void NumberDialog::accept() {
  for (QuantityEdit* field : findChildren<QuantityEdit*>()) {
    Q_EMIT field->editingFinished();  // applies unfinished input
    if (field->property("refused").toBool()) {
      problem_->setText(tr("“%1”: %2").arg(field->text(), field->toolTip()));
      field->setFocus();
      return;
    }
  }
  QDialog::accept();
}

}  // namespace palpa::gui

#include "app/gui/compare/state_choice_dialog.h"

#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/base/appearance.h"

namespace palpa::gui {

StateChoiceDialog::StateChoiceDialog(const modeling::Document::History& history,
                                     const QString& file, QWidget* parent)
    : QDialog(parent), list_(new QListWidget(this)) {
  setWindowTitle(tr("Compare with the state before"));
  setObjectName("stateChoice");
  list_->setObjectName("states");
  list_->setAccessibleName(tr("Steps, the latest first"));
  // The latest step first: usually its effect is the question.
  for (std::size_t step = history.position; step > 0; --step) {
    auto* item =
        new QListWidgetItem(icon("history"), QString::fromStdString(history.labels[step]), list_);
    item->setData(Qt::UserRole, QVariant::fromValue<qulonglong>(step));
  }
  if (!file.isEmpty()) {
    auto* item = new QListWidgetItem(
        icon("save"), tr("The saved version, %1").arg(QFileInfo(file).fileName()), list_);
    item->setData(Qt::UserRole, 0);
  }
  list_->setCurrentRow(0);
  auto* words = new QLabel(tr("Compare the project with its state before this step:"), this);
  words->setBuddy(list_);
  auto* buttons = new QDialogButtonBox(this);
  buttons->addButton(tr("&Compare"), QDialogButtonBox::AcceptRole);
  buttons->addButton(QDialogButtonBox::Cancel);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(list_, &QListWidget::itemActivated, this, &QDialog::accept);
  auto* column = new QVBoxLayout(this);
  column->addWidget(words);
  column->addWidget(list_);
  column->addWidget(buttons);
  list_->setFocus();
}

std::size_t StateChoiceDialog::step() const {
  const QListWidgetItem* item = list_->currentItem();
  return item ? static_cast<std::size_t>(item->data(Qt::UserRole).toULongLong()) : 0;
}

}  // namespace palpa::gui

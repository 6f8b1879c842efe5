#include "app/gui/widgets/field_input.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSpinBox>

#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {
namespace {

/// The text of a field; null for combo boxes without text input.
const QLineEdit* textOf(const QWidget& field) {
  const auto* edit = qobject_cast<const QLineEdit*>(&field);
  return edit ? edit : field.findChild<const QLineEdit*>();
}

template <class Box>
void showAgain(Box& box) {
  const QSignalBlocker blocker(box);
  box.setValue(box.value());
}

}  // namespace

bool isField(const QWidget& widget) {
  return qobject_cast<const QLineEdit*>(&widget) ||
         qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QComboBox*>(&widget);
}

bool hasUnfinishedInput(const QWidget& field) {
  const QLineEdit* text = isField(field) ? textOf(field) : nullptr;
  return text && !text->isReadOnly() && text->isModified();
}

void dropInput(QWidget& field, const QString& former) {
  if (!hasUnfinishedInput(field)) return;
  if (auto* quantity = qobject_cast<QuantityEdit*>(&field)) {
    quantity->showValue();
  } else if (auto* edit = qobject_cast<QLineEdit*>(&field)) {
    edit->setText(former);
  } else if (auto* box = qobject_cast<QSpinBox*>(&field)) {
    showAgain(*box);
  } else if (auto* number = qobject_cast<QDoubleSpinBox*>(&field)) {
    showAgain(*number);
  }
}

void finishInput(QWidget& window) {
  QWidget* field = QApplication::focusWidget();
  if (!field) field = window.focusWidget();  // another program is active
  if (!field || !isField(*field)) return;
  for (const QWidget* each = field; each; each = each->parentWidget()) {
    if (each != &window) continue;
    field->clearFocus();
    return;
  }
}

}  // namespace palpa::gui

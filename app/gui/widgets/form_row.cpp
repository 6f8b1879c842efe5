#include "app/gui/widgets/form_row.h"

namespace palpa::gui {

void addFormRow(QFormLayout* form, const QString& label, QWidget* field, const QString& name,
                const QString& tip) {
  field->setObjectName(name);
  QString plain = label;
  field->setAccessibleName(plain.remove('&'));
  field->setToolTip(tip);
  form->addRow(label, field);
}

void setFormRowVisible(QFormLayout* form, QWidget* field, bool isVisible) {
  field->setVisible(isVisible);
  if (QWidget* label = form->labelForField(field)) label->setVisible(isVisible);
}

}  // namespace palpa::gui

#include "app/gui/widgets/vector_edit.h"

#include <QHBoxLayout>

namespace palpa::gui {

VectorEdit::VectorEdit(Quantity quantity, const Settings& settings, QWidget* parent)
    : QWidget(parent) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  for (int i = 0; i < 3; ++i) {
    fields_[i] = new QuantityEdit(quantity, settings, this);
    fields_[i]->setObjectName(QStringLiteral("xyz").mid(i, 1));
    fields_[i]->setAccessibleName(QStringLiteral("xyz").mid(i, 1));
    fields_[i]->setNarrow();
    layout->addWidget(fields_[i], 1);
    connect(fields_[i], &QuantityEdit::edited, this, [this] { Q_EMIT edited(value()); });
  }
  setFocusProxy(fields_[0]);
}

Eigen::Vector3d VectorEdit::value() const {
  return {fields_[0]->value(), fields_[1]->value(), fields_[2]->value()};
}

void VectorEdit::setValue(const Eigen::Vector3d& value) {
  for (int i = 0; i < 3; ++i) fields_[i]->setValue(value[i]);
}

}  // namespace palpa::gui

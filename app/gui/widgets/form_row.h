#pragma once

#include <QFormLayout>

namespace palpa::gui {

/// Adds a row with a label that is the buddy of its field; `name` is the field's object name.
void addFormRow(QFormLayout* form, const QString& label, QWidget* field, const QString& name,
                const QString& tip = {});

/// Shows or hides a field together with its label.
void setFormRowVisible(QFormLayout* form, QWidget* field, bool isVisible);

}  // namespace palpa::gui

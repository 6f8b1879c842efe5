#pragma once

#include <QComboBox>
#include <QFormLayout>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// A list of the things a tool can work on: a new one, or one that is there. It shows and sets the
/// selection.
class ConditionChoice : public QComboBox {
  Q_OBJECT

 public:
  /// `fresh`: what stands for a new one.
  ConditionChoice(Editor& editor, Selection::Kind kind, const QString& fresh, QWidget* parent);

  /// Lists what is there now: of loads those of one alternative of Load::what, by its index.
  void refresh(std::optional<std::size_t> alternative = {});

 private:
  Editor& editor_;
  Selection::Kind kind_;
  QString fresh_;
};

/// A row with a label that is the buddy of its field.
void addRow(QFormLayout* form, const QString& label, QWidget* field, const QString& name,
            const QString& tip = {});

}  // namespace palpa::gui

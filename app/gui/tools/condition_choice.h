#pragma once

#include <QComboBox>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// List of the supports or loads that a tool can edit: a new one, or an existing one. Shows and
/// sets the selection.
class ConditionChoice : public QComboBox {
  Q_OBJECT

 public:
  /// `fresh`: text for a new one.
  ConditionChoice(Editor& editor, Selection::Kind kind, const QString& fresh, QWidget* parent);

  /// Lists the present supports or loads; only loads with this index of Load::what, if given.
  void refresh(std::optional<std::size_t> alternative = {});

 private:
  Editor& editor_;
  Selection::Kind kind_;
  QString fresh_;
};

}  // namespace palpa::gui

#pragma once

#include <QComboBox>

#include "app/gui/tools/condition_choice.h"
#include "app/gui/tools/support_tool.h"
#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {

/// Options of SupportTool.
class SupportOptions : public QWidget {
  Q_OBJECT

 public:
  SupportOptions(SupportTool& tool, Editor& editor, const Settings& settings, QWidget* parent);

 private:
  void refresh();

  SupportTool& tool_;
  QComboBox* brush_;
  ConditionChoice* support_;
  QComboBox* kind_;
  QuantityEdit* radius_;
};

}  // namespace palpa::gui

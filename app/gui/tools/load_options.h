#pragma once

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <array>

#include "app/gui/tools/condition_choice.h"
#include "app/gui/tools/load_tool.h"
#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {

/// Options of LoadTool.
class LoadOptions : public QWidget {
  Q_OBJECT

 public:
  LoadOptions(LoadTool& tool, Editor& editor, const Settings& settings, QWidget* parent);

 private:
  void refresh();

  LoadTool& tool_;
  Editor& editor_;
  const Settings& settings_;
  QFormLayout* form_;
  QComboBox* kind_;
  ConditionChoice* load_;
  QuantityEdit* strength_;
  std::array<VectorEdit*, kLoadKindCount> vectors_{};  // by kind; null for kinds without a vector
  QuantityEdit* radius_;
  QPushButton* earth_;
  QPushButton* addGravity_;
  QLabel* share_;
};

}  // namespace palpa::gui

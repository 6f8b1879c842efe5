#pragma once

#include <QComboBox>
#include <QFormLayout>
#include <QPushButton>
#include <QWidget>
#include <functional>

#include "app/gui/simulate/exact_touch.h"
#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {

/// Fields of an exact touch, and buttons that apply, keep, store and sweep it.
class ExactTouchOptions : public QWidget {
  Q_OBJECT

 public:
  /// `sweep` opens the force-depth curve.
  ExactTouchOptions(ExactTouch& touch, Settings& settings, const std::function<void()>& sweep,
                    QWidget* parent);

 private:
  void makeFields();
  void makeButtons(const std::function<void()>& sweep);
  void refresh();

  ExactTouch& touch_;
  QFormLayout* form_;
  QComboBox* kind_;
  VectorEdit* place_;
  QComboBox* direction_;
  VectorEdit* vector_;
  QuantityEdit* depth_;
  QuantityEdit* force_;
  QuantityEdit* radius_;
  QuantityEdit* friction_;
  QPushButton* apply_;
  QPushButton* keep_;
  QPushButton* store_;
  QPushButton* sweep_;
};

}  // namespace palpa::gui

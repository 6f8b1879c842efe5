#pragma once

#include <QLineEdit>
#include <limits>

#include "app/gui/base/settings.h"

namespace palpa::gui {

/// A field for one number with its unit. What is typed counts when Enter is pressed or the field is
/// left; text that is no number, or out of range, is marked and says why in the tool tip, and the
/// last good value stays. Arrow keys and the wheel (while focused) change it by a step.
class QuantityEdit : public QLineEdit {
  Q_OBJECT

 public:
  QuantityEdit(Quantity quantity, const Settings& settings, QWidget* parent = nullptr);

  /// In the program's own unit; rad for angles.
  double value() const { return value_; }
  /// Shows a value; does not emit `edited`.
  void setValue(double value);
  /// Smallest and largest value accepted, both included.
  void setRange(double least, double most);
  /// Shows few digits while the field has not the focus; the value keeps all of them.
  void setNarrow();
  /// By which arrow keys and the wheel change the value; 0 (the default): a tenth of its leading
  /// power of ten.
  void setStep(double step) { step_ = step; }

 Q_SIGNALS:
  /// A person has entered another value.
  void edited(double value);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void commit();
  void stepBy(double steps);
  void showValue();
  void refuse(const QString& why);
  void setRefused(bool isRefused);
  void accept(double value);

  Quantity quantity_;
  const Settings& settings_;
  double value_ = 0;
  double least_ = -std::numeric_limits<double>::infinity();
  double most_ = std::numeric_limits<double>::infinity();
  double step_ = 0;
  bool isNarrow_ = false;
};

}  // namespace palpa::gui

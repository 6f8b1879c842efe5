#pragma once

#include <QLineEdit>
#include <limits>

#include "app/gui/base/settings.h"

namespace palpa::gui {

/// Field for one number with its unit. Text is applied when the user presses Enter or leaves the
/// field. Invalid text is marked, the tool tip states the reason, and the value does not change.
/// Arrow keys and the wheel (while focused) change the value by a step.
class QuantityEdit : public QLineEdit {
  Q_OBJECT

 public:
  QuantityEdit(Quantity quantity, const Settings& settings, QWidget* parent = nullptr);

  /// In the program's unit; rad for angles. NaN: an optional field is empty.
  double value() const { return value_; }
  /// Shows a value; does not emit `edited`.
  void setValue(double value);
  /// Shows the value again and drops input that was not applied.
  void showValue();
  /// Smallest and largest value accepted, both included.
  void setRange(double least, double most);
  /// The field may be empty, its value is then NaN; `placeholder` is shown instead.
  void setOptional(const QString& placeholder);
  bool isOptional() const { return isOptional_; }
  /// Shows fewer digits while the field has no focus; the value keeps all digits.
  void setNarrow();
  /// Step of arrow keys and wheel; 0 (the default): a tenth of the leading power of ten of the
  /// value.
  void setStep(double step) { step_ = step; }

 Q_SIGNALS:
  /// The user entered another value.
  void edited(double value);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void commit();
  void stepBy(double steps);
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
  bool isOptional_ = false;
};

}  // namespace palpa::gui

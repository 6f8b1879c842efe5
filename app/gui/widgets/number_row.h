#pragma once

#include <QLabel>
#include <optional>

#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {

/// Number field of a dialog with an error text below. The text is checked at every keystroke, so
/// that the dialog can disable OK.
class NumberRow : public QWidget {
  Q_OBJECT

 public:
  NumberRow(Quantity quantity, const Settings& settings, QWidget* parent = nullptr);

  QuantityEdit& field() { return *field_; }
  /// Both ends included.
  void setRange(double least, double most);
  void setValue(double value);
  /// Present content in the program's unit; nothing while it is invalid or empty.
  std::optional<double> value() const;
  /// The field may be empty; `placeholder` is then shown.
  void setOptional(const QString& placeholder);
  void clear();
  /// True for a number in the range, and for an optional field without one.
  bool isValid() const { return ownProblem().isEmpty(); }
  /// Error found by the owner; empty for none.
  void setProblem(const QString& problem);

 Q_SIGNALS:
  /// The text changed, by the user or by setValue().
  void changed();

 private:
  bool isEmpty() const;
  QString ownProblem() const;
  void showProblem();

  Quantity quantity_;
  const Settings& settings_;
  QuantityEdit* field_;
  QLabel* problem_;
  QString problemOfOwner_;
  double least_ = -std::numeric_limits<double>::infinity();
  double most_ = std::numeric_limits<double>::infinity();
};

}  // namespace palpa::gui

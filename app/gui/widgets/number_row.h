#pragma once

#include <QLabel>
#include <optional>

#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {

/// A number field of a dialog with its problem beneath it: judged while it is typed, so that a
/// dialog can follow every keystroke and keep OK disabled meanwhile.
class NumberRow : public QWidget {
  Q_OBJECT

 public:
  NumberRow(Quantity quantity, const Settings& settings, QWidget* parent = nullptr);

  QuantityEdit& field() { return *field_; }
  /// Both ends included.
  void setRange(double least, double most);
  void setValue(double value);
  /// What stands in the field now, in the program's own unit; nothing while it is wrong.
  std::optional<double> value() const;
  /// A problem that only the owner knows; empty for none.
  void setProblem(const QString& problem);

 Q_SIGNALS:
  /// The text changed, by typing, keys, the wheel or setValue().
  void changed();

 private:
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

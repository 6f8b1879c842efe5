#pragma once

#include <QDialog>
#include <QFormLayout>
#include <QLabel>

#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {

/// Asks for exact numbers. OK is refused, with the reason, while a number is invalid.
class NumberDialog : public QDialog {
  Q_OBJECT

 public:
  /// `text`: sentence about the effect.
  NumberDialog(const QString& title, const QString& text, const Settings& settings,
               QWidget* parent);

  VectorEdit& addVector(const QString& label, const Eigen::Vector3d& value);  ///< lengths, mm
  QuantityEdit& addLength(const QString& label, double value);                ///< mm

  void accept() override;

 private:
  const Settings& settings_;
  QFormLayout* form_;
  QLabel* problem_;
};

}  // namespace palpa::gui

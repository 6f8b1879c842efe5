#pragma once

#include <Eigen/Core>
#include <QWidget>
#include <array>

#include "app/gui/widgets/quantity_edit.h"

namespace palpa::gui {

/// Fields for x, y and z in one row.
class VectorEdit : public QWidget {
  Q_OBJECT

 public:
  VectorEdit(Quantity quantity, const Settings& settings, QWidget* parent = nullptr);

  Eigen::Vector3d value() const;
  void setValue(const Eigen::Vector3d& value);
  QuantityEdit& component(int i) { return *fields_[i]; }

 Q_SIGNALS:
  void edited(const Eigen::Vector3d& value);

 private:
  std::array<QuantityEdit*, 3> fields_;
};

}  // namespace palpa::gui

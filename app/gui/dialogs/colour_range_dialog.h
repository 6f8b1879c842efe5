#pragma once

#include <QDialog>
#include <QDialogButtonBox>
#include <array>
#include <optional>

#include "app/gui/base/settings.h"
#include "app/gui/widgets/number_row.h"

namespace palpa::gui {

/// Asks for the ends of the colours of a field. OK is disabled unless the first is less than the
/// second.
class ColourRangeDialog : public QDialog {
  Q_OBJECT

 public:
  /// `range` in the program's unit.
  ColourRangeDialog(Quantity quantity, const std::array<double, 2>& range, const Settings& settings,
                    QWidget* parent);

  std::array<double, 2> range() const;

 private:
  void check();

  NumberRow *low_, *high_;
  QDialogButtonBox* buttons_;
};

}  // namespace palpa::gui

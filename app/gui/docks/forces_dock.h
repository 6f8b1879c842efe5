#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QTimer>
#include <map>

#include "app/gui/base/settings.h"
#include "app/gui/docks/force_table.h"
#include "app/gui/simulate/force_history.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/widgets/plot_widget.h"

namespace palpa::gui {

class AccuracyPanel;

/// Panel with force, deflection and stiffness of every contact, the supports' reactions, energy
/// and balance, updated several times a second.
class ForcesDock : public QDockWidget {
  Q_OBJECT

 public:
  ForcesDock(Simulation& simulation, Editor& editor, Settings& settings, QWidget* parent);

  /// See ForceTable.
  QString text(int row, int column) const { return table_->text(row, column); }
  QString details(int row) const { return table_->details(row); }

 private:
  void showForces();
  void showPlot();
  ForceTable::Row rowOf(const app::TouchSnapshot::Contact& contact);
  /// Row of a load or a support; `verb` says what the force or moment does to the body. `error`:
  /// relative, 0 for given numbers.
  ForceTable::Row rowOf(const QString& name, const QString& verb, const Eigen::Vector3d& vector,
                        Quantity quantity, double error = 0) const;
  /// Relative errors; 0 while they are unknown.
  double errorOf(const app::TouchSnapshot::Contact& contact) const;
  double errorOfReactions() const;
  /// Limits of the shown forces and hints, each after a line break.
  QString notes() const;

  Simulation& simulation_;
  const Editor& editor_;
  const Settings& settings_;
  ForceTable* table_;
  QLabel* summary_;
  PlotWidget* plot_;
  AccuracyPanel* accuracy_;
  ForceHistory history_;
  double bodySize_ = 0;  // mm, the diagonal of the drawn body's box
  QTimer soon_;
};

}  // namespace palpa::gui

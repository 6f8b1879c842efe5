#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QTimer>
#include <QTreeWidget>

#include "app/gui/settings.h"
#include "app/gui/simulate/force_history.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/widgets/plot_widget.h"

namespace palpa::gui {

/// What the hand feels: force, displacement and stiffness of every contact, the supports'
/// reactions, energy and balance, some times a second while something is touched.
class ForcesDock : public QDockWidget {
  Q_OBJECT

 public:
  ForcesDock(Simulation& simulation, const Settings& settings, QWidget* parent);

  /// The words of a cell, as a person reads them; empty when there is none.
  QString text(int row, int column) const;

 private:
  void showForces();
  void showPlot();
  void fillRow(int row, const QStringList& texts);
  QString vectorText(const Eigen::Vector3d& vector, Quantity quantity) const;
  QString shownAs(double value, Quantity quantity) const;

  Simulation& simulation_;
  const Settings& settings_;
  QTreeWidget* list_;
  QLabel* summary_;
  PlotWidget* plot_;
  ForceHistory history_;
  QTimer soon_;
};

}  // namespace palpa::gui

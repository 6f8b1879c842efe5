#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QTimer>
#include <QTreeWidget>
#include <map>

#include "app/gui/base/settings.h"
#include "app/gui/simulate/force_history.h"
#include "app/gui/simulate/simulation.h"
#include "app/gui/widgets/plot_widget.h"

namespace palpa::gui {

/// What the hand feels: force, displacement and stiffness of every contact, the supports'
/// reactions, energy and balance, some times a second while something is touched.
class ForcesDock : public QDockWidget {
  Q_OBJECT

 public:
  ForcesDock(Simulation& simulation, const Editor& editor, const Settings& settings,
             QWidget* parent);

  /// The words of a cell, as a person reads them; empty when there is none.
  QString text(int row, int column) const;
  /// Those below the row: what the contact does, and the components of its force.
  QString details(int row) const;

 protected:
  /// Delete lets go of the chosen contact.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void letGoOfChosen();
  void showMenu(const QPoint& at);
  void showForces();
  void showPlot();
  struct Row {
    QStringList cells;
    QString details;
    app::TouchId contact = 0;  ///< 0: not a contact
    int curve = -1;            ///< number of its curve in the plot; -1: none
  };
  /// A contact keeps its number as long as it, or its curve, is seen; numbers begin with 1 again
  /// when there is none.
  int numberOf(app::TouchId contact);
  void fillRow(int row, const Row& filled);

  Simulation& simulation_;
  const Editor& editor_;
  const Settings& settings_;
  QTreeWidget* list_;
  QLabel* summary_;
  PlotWidget* plot_;
  ForceHistory history_;
  std::map<app::TouchId, int> numbers_;
  double bodySize_ = 0;  // mm, the diagonal of the drawn body's box
  QTimer soon_;
};

}  // namespace palpa::gui

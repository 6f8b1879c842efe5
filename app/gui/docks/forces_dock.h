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

class AccuracyPanel;

/// Panel with force, deflection and stiffness of every contact, the supports' reactions, energy
/// and balance, updated several times a second.
class ForcesDock : public QDockWidget {
  Q_OBJECT

 public:
  ForcesDock(Simulation& simulation, Editor& editor, Settings& settings, QWidget* parent);

  /// Text of a cell; empty if absent.
  QString text(int row, int column) const;
  /// Text below the row: state of the contact and components of its force.
  QString details(int row) const;

 protected:
  /// Delete ends the selected contact.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void endSelected();
  void showMenu(const QPoint& at);
  void showForces();
  void showPlot();
  struct Row {
    QStringList cells;
    QString details;
    app::TouchId contact = 0;  ///< 0: not a contact
    int curve = -1;            ///< number of the curve in the plot; -1: none
  };
  /// Number of a contact: constant while the contact or its curve is visible. Numbers restart
  /// with 1.
  int numberOf(app::TouchId contact);
  void fillRow(int row, const Row& filled);

  Simulation& simulation_;
  const Editor& editor_;
  const Settings& settings_;
  QTreeWidget* list_;
  QLabel* summary_;
  PlotWidget* plot_;
  AccuracyPanel* accuracy_;
  ForceHistory history_;
  std::map<app::TouchId, int> numbers_;
  double bodySize_ = 0;  // mm, the diagonal of the drawn body's box
  QTimer soon_;
};

}  // namespace palpa::gui

#pragma once

#include <QTreeWidget>
#include <vector>

#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Table of the forces on the body: a row with a line of details below it for every contact, load
/// and support. Delete or the menu ends the selected contact.
class ForceTable : public QTreeWidget {
  Q_OBJECT

 public:
  struct Row {
    QStringList cells;         ///< name, force, deflection, stiffness
    QString details;           ///< hidden if empty
    app::TouchId contact = 0;  ///< 0: not a contact
    int curve = -1;            ///< number of the curve in the plot; -1: none
  };

  ForceTable(Simulation& simulation, QWidget* parent);

  /// Replaces the rows; the selection stays.
  void showRows(const std::vector<Row>& rows);

  /// Text of a cell; empty if absent.
  QString text(int row, int column) const;
  /// Text below the row: state of the contact and components of its force.
  QString details(int row) const;

 protected:
  /// Handles Delete before Edit > Delete, which acts on the project.
  bool event(QEvent* event) override;

 private:
  void fillRow(int row, const Row& filled);
  void endSelected();
  void showMenu(const QPoint& at);

  Simulation& simulation_;
};

}  // namespace palpa::gui

#pragma once

#include <QDialog>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <memory>
#include <vector>

#include "app/core/results/touch_sweep.h"
#include "app/gui/base/settings.h"
#include "app/gui/widgets/plot_widget.h"
#include "app/gui/widgets/quantity_edit.h"
#include "app/gui/workspace/workspace.h"
#include "base/worker_thread.h"

namespace palpa::gui {

/// Force-depth curve of one touch: computes it in the background, draws it, lists it and exports
/// it. Escape stops the computation; then it closes the dialog.
class SweepDialog : public QDialog {
  Q_OBJECT

 public:
  SweepDialog(const Workspace& workspace, std::shared_ptr<const app::TouchModel> model,
              modeling::Touch touch);
  ~SweepDialog() override;

  bool isRunning() const { return isRunning_; }
  const std::vector<app::SweepRow>& rows() const { return rows_; }

  void reject() override;

 private:
  void run();
  void stop();
  static QString stoppedText();
  void add(const app::SweepRow& row);
  void finish(const QString& message);
  void showUnits();
  void showPlot();
  void showRow(int index);
  void showButtons();
  void copy();
  void save();
  /// Length of the displacement or force that a state prescribes, in the chosen unit.
  double given(const app::SweepRow& row) const;

  Workspace workspace_;
  std::shared_ptr<const app::TouchModel> model_;
  modeling::Touch touch_;
  std::vector<app::SweepRow> rows_;
  bool isRunning_ = false;
  std::uint64_t run_ = 0;  // number of the present run: older ones may still report
  QuantityEdit* most_;
  QSpinBox* steps_;
  QPushButton* start_;
  QProgressBar* progress_;
  PlotWidget* plot_;
  QTableWidget* table_;
  QLabel* message_;
  QPushButton* copy_;
  QPushButton* save_;
  WorkerThread worker_;  // last: it uses all of the above
};

}  // namespace palpa::gui

#pragma once

#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>

#include "app/gui/simulate/samples.h"

namespace palpa::gui {

/// Panel with all fields of the pinned samples: one column per sample.
class SamplesDock : public QDockWidget {
  Q_OBJECT

 public:
  SamplesDock(Samples& samples, SectionView& section, Settings& settings, QWidget* parent);

 protected:
  /// Delete removes the selected sample, Ctrl+C copies.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void showSamples();
  /// Selects the column of the selected sample.
  void showSelected();
  void copy() const;
  void save();
  void saveSection();

  Samples& samples_;
  SectionView& section_;
  Settings& settings_;
  QTableWidget* table_;
  QLabel* hint_;
  QPushButton *copy_, *save_, *remove_, *saveSection_;
  bool isFilling_ = false;
};

}  // namespace palpa::gui

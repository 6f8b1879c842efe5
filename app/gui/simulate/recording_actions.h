#pragma once

#include <QAction>
#include <QObject>
#include <functional>

#include "app/gui/simulate/recorder.h"
#include "app/gui/workspace/workspace.h"

namespace palpa::gui {

/// Entries of the Simulate menu that record, replay and export.
class RecordingActions : public QObject {
  Q_OBJECT

 public:
  RecordingActions(const Workspace& workspace, Simulation& simulation);

  Recorder& recorder() { return recorder_; }

 private:
  void update();
  void toggleRecording(bool on);
  void saveRecording();
  void openRecording();
  void exportTable();
  void exportSeries();
  /// Runs work that writes a file; says that it is done, or why it cannot be.
  void writeInBackground(const QString& file, const QString& done,
                         const std::function<void(const Job&)>& work);
  void exportAnimation();
  /// Draws the pictures of a replay; returns their number, 0 if the user cancelled.
  std::size_t drawInto(const std::filesystem::path& folder, const QSize& size);

  Workspace workspace_;
  Simulation& simulation_;
  Recorder recorder_;
  QAction* record_;
  QAction* replay_;
  QAction* save_;
  QAction* open_;
  QAction* table_;
  QAction* series_;
  QAction* animation_;
};

}  // namespace palpa::gui

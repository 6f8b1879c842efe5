#pragma once

#include <QObject>
#include <filesystem>
#include <optional>
#include <thread>

#include "app/core/live/touch_recording_file.h"
#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Records and replays the contacts of Simulate mode and writes the forces of every millisecond.
/// Holds one recording, which belongs to the window, not to the project.
class Recorder : public QObject {
  Q_OBJECT

 public:
  explicit Recorder(Simulation& simulation, QObject* parent = nullptr);
  ~Recorder() override;

  bool isRecording() const { return isRecording_; }
  void start();
  void stop();
  /// Nothing before the first recording.
  const std::optional<app::TouchRecording>& recording() const { return recording_; }
  /// Model of recording(); its name is empty until the recording is saved or opened.
  const app::RecordedModel& recordedModel() const { return recordedModel_; }
  /// Takes a recording from a file. Stops recording and replay.
  void open(app::RecordingFile file);

  bool isReplaying() const { return isReplaying_; }
  /// Sends the recording to the touch loop, at the recorded speed.
  void replay();
  void stopReplay();

  /// Writes the forces of a replay as app::TouchTable. Throws Error if the file cannot be written;
  /// then, and if it is cancelled, an existing file is unchanged.
  static void writeTable(const std::shared_ptr<const app::TouchableModel>& body,
                         const app::TouchRecording& recording, const std::filesystem::path& file,
                         const Job& job);

  /// Writes a replay as app::ReplaySeries at its usual rate. Throws Error if it cannot be written;
  /// then, and if it is cancelled, nothing is written.
  static void writeSeries(const std::shared_ptr<const app::TouchableModel>& body,
                          const app::TouchRecording& recording,
                          const std::filesystem::path& collection, const Job& job);

 Q_SIGNALS:
  /// isRecording(), isReplaying() or recording() changed.
  void changed();

 private:
  Simulation& simulation_;
  bool isRecording_ = false, isReplaying_ = false;
  std::optional<app::TouchRecording> recording_;
  app::RecordedModel recordedModel_;
  std::jthread player_;
};

}  // namespace palpa::gui

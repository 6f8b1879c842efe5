#pragma once

#include <QObject>
#include <filesystem>
#include <optional>
#include <thread>

#include "app/core/live/touch_recording_file.h"
#include "app/gui/simulate/simulation.h"

namespace palpa::gui {

/// Records what the hand does in Simulate mode, does it again, and tells the forces of every
/// millisecond. One recording at a time; it belongs to the window, not to the project.
class Recorder : public QObject {
  Q_OBJECT

 public:
  explicit Recorder(Simulation& simulation, QObject* parent = nullptr);
  ~Recorder() override;

  bool isRecording() const { return isRecording_; }
  void start();
  void stop();
  /// None before the first.
  const std::optional<app::TouchRecording>& recording() const { return recording_; }
  /// What recording() was made on; its name is empty until it was saved or opened.
  const app::RecordedModel& recordedModel() const { return recordedModel_; }
  /// Takes a recording from a file; what is being recorded or replayed ends.
  void open(app::RecordingFile file);

  bool isReplaying() const { return isReplaying_; }
  /// Plays the recording to the touch loop, as fast as it was made.
  void replay();
  void stopReplay();

  /// What a replay on the present body gives; each snapshot as soon as it is there, on the caller's
  /// thread. Throws SolverError, Cancelled.
  static void play(const std::shared_ptr<const app::TouchModel>& model,
                   const app::TouchRecording& recording, const Job& job,
                   const std::function<void(const app::TouchSnapshot&)>& seen);
  /// Writes app::TouchTable. Throws std::runtime_error naming the file.
  static void writeTable(const std::shared_ptr<const app::TouchModel>& model,
                         const app::TouchRecording& recording, const std::filesystem::path& file,
                         const Job& job);

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

#include "app/gui/simulate/recorder.h"

#include <QMetaObject>
#include <fstream>
#include <map>

#include "app/core/live/touch_replay.h"
#include "app/core/live/touch_table.h"
#include "base/worker_thread.h"
#include "bem/base/error.h"

namespace palpa::gui {

Recorder::Recorder(Simulation& simulation, QObject* parent)
    : QObject(parent), simulation_(simulation) {
  connect(&simulation, &Simulation::leaving, this, [this] {
    stop();
    stopReplay();
  });
}

Recorder::~Recorder() = default;

void Recorder::start() {
  if (isRecording_ || !simulation_.isActive()) return;
  simulation_.loop().startRecording();
  isRecording_ = true;
  Q_EMIT changed();
}

void Recorder::stop() {
  if (!isRecording_) return;
  isRecording_ = false;
  app::TouchRecording recording = simulation_.loop().stopRecording();
  if (!recording.entries.empty()) {
    recording_ = std::move(recording);
    recordedModel_ = {};
    if (const auto body = simulation_.body())
      recordedModel_ = app::recordedModelOf(body->model(), {});
  }
  Q_EMIT changed();
}

void Recorder::open(app::RecordingFile file) {
  stop();
  stopReplay();
  recording_ = std::move(file.recording);
  recordedModel_ = std::move(file.model);
  Q_EMIT changed();
}

void Recorder::replay() {
  if (isReplaying_ || !recording_ || !simulation_.isActive()) return;
  stop();
  simulation_.endAll();
  isReplaying_ = true;
  Q_EMIT changed();
  player_ = std::jthread([this, recording = *recording_](const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    app::TouchLoop& loop = simulation_.loop();
    std::map<app::TouchId, app::TouchId> ids;  // of the recording, of the loop
    const auto begin = Clock::now();
    const auto at = [&](std::uint64_t step) {
      return begin + app::TouchLoop::kPeriod * static_cast<std::int64_t>(step);
    };
    for (const app::TouchRecording::Entry& entry : recording.entries) {
      if (!sleepUntil(at(entry.step), stop)) break;
      const app::TouchCommand& command = entry.command;
      try {
        if (command.kind == app::TouchCommand::Kind::kBegin)
          ids[command.id] = loop.begin(command.tool, command.at, command.value);
        else if (ids.contains(command.id) && command.kind == app::TouchCommand::Kind::kSet)
          loop.set(ids[command.id], command.value);
        else if (ids.contains(command.id))
          loop.end(ids[command.id]);
      } catch (const app::TouchRefused&) {
        // Skip a contact that the loop refuses beside the present ones.
      }
    }
    if (!stop.stop_requested()) sleepUntil(at(recording.steps), stop);
    for (const auto& [before, now] : ids) loop.end(now);
    QMetaObject::invokeMethod(
        this,
        [this] {
          isReplaying_ = false;
          Q_EMIT changed();
        },
        Qt::QueuedConnection);
  });
}

void Recorder::stopReplay() {
  player_ = {};
}

void Recorder::play(const std::shared_ptr<const app::TouchModel>& model,
                    const app::TouchRecording& recording, const Job& job,
                    const std::function<void(const app::TouchSnapshot&)>& seen) {
  app::replay(std::make_shared<const app::TouchableModel>(model), recording, job, seen);
}

void Recorder::writeTable(const std::shared_ptr<const app::TouchModel>& model,
                          const app::TouchRecording& recording, const std::filesystem::path& file,
                          const Job& job) {
  std::ofstream out(file);
  app::TouchTable table(out);
  std::uint64_t step = 0;
  play(model, recording, job,
       [&](const app::TouchSnapshot& snapshot) { table.add(snapshot, step++); });
  out.close();
  if (!out)
    throw std::runtime_error(
        tr("%1 cannot be written; choose another folder, or make room on the disk")
            .arg(QString::fromStdString(file.string()))
            .toStdString());
}

}  // namespace palpa::gui

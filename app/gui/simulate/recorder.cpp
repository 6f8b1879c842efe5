#include "app/gui/simulate/recorder.h"

#include <QMetaObject>
#include <map>
#include <sstream>

#include "app/core/live/touch_replay.h"
#include "app/core/live/touch_table.h"
#include "app/core/results/state_series.h"
#include "base/atomic_file.h"
#include "base/unexpected.h"
#include "base/worker_thread.h"

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
      } catch (...) {
        reportUnexpected();
        break;
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

void Recorder::writeTable(const std::shared_ptr<const app::TouchableModel>& body,
                          const app::TouchRecording& recording, const std::filesystem::path& file,
                          const Job& job) {
  AtomicFile target(file);  // fails before the replay if it cannot be written
  std::ostringstream text;
  app::TouchTable table(text);
  std::uint64_t step = 0;
  app::replay(body, recording, job,
              [&](const app::TouchSnapshot& snapshot) { table.add(snapshot, step++); });
  target.write(text.view());
  target.commit();
}

void Recorder::writeSeries(const std::shared_ptr<const app::TouchableModel>& body,
                           const app::TouchRecording& recording,
                           const std::filesystem::path& collection, const Job& job) {
  app::ReplaySeries series(body, app::ReplaySeries::kUsualRate, collection);
  std::uint64_t step = 0;
  app::replay(body, recording, job,
              [&](const app::TouchSnapshot& snapshot) { series.add(snapshot, step++); });
  job.throwIfCancelled();
  series.commit();
}

}  // namespace palpa::gui

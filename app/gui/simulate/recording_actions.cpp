#include "app/gui/simulate/recording_actions.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QStatusBar>
#include <QTemporaryDir>

#include "app/core/live/touch_replay.h"
#include "app/gui/base/background_job.h"
#include "app/gui/dialogs/file_dialogs.h"
#include "app/gui/dialogs/picture_dialog.h"
#include "app/gui/simulate/animation.h"
#include "app/gui/view/viewport_widget.h"
#include "app/gui/workspace/menus.h"
#include "base/atomic_file.h"
#include "modeling/error.h"

namespace palpa::gui {
namespace {

constexpr std::uint64_t kStepsPerPicture = 1000 / kAnimationRate;

}  // namespace

RecordingActions::RecordingActions(const Workspace& workspace, Simulation& simulation)
    : QObject(&workspace.window),
      workspace_(workspace),
      simulation_(simulation),
      recorder_(simulation) {
  Menus& menus = workspace.menus;
  menus.simulate->addSeparator();
  record_ = menus.addToggle(menus.simulate,
                            {"record", tr("&Record"), QKeySequence(Qt::CTRL | Qt::Key_R),
                             tr("Record all touches, a thousand times a second")},
                            false, this, [this](bool on) { toggleRecording(on); });
  replay_ = menus.add(menus.simulate,
                      {"replay", tr("Re&play"), QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_R),
                       tr("Repeat the recorded touches")},
                      this, [this] {
                        if (recorder_.isReplaying())
                          recorder_.stopReplay();
                        else
                          recorder_.replay();
                      });
  save_ = menus.add(menus.simulate,
                    {nullptr, tr("Sa&ve recording …"), {}, tr("Write the recording to a file")},
                    this, [this] { saveRecording(); });
  open_ = menus.add(menus.simulate,
                    {nullptr,
                     tr("Ope&n recording …"),
                     {},
                     tr("Read a recording from a file, to replay and export it")},
                    this, [this] { openRecording(); });
  table_ = menus.add(menus.simulate,
                     {nullptr,
                      tr("Export &forces …"),
                      {},
                      tr("Write the forces of every millisecond of the recording as a table")},
                     this, [this] { exportTable(); });
  series_ = menus.add(
      menus.simulate,
      {nullptr,
       tr("Export &series …"),
       {},
       tr("Write the recording as meshes with displacement and traction over time, for ParaView")},
      this, [this] { exportSeries(); });
  animation_ = menus.add(
      menus.simulate,
      {nullptr, tr("Export &animation …"), {}, tr("Write the recording as pictures or as a video")},
      this, [this] { exportAnimation(); });
  for (QAction* action : {record_, replay_}) menus.bar->addAction(action);
  connect(&recorder_, &Recorder::changed, this, &RecordingActions::update);
  connect(&simulation, &Simulation::activeChanged, this, &RecordingActions::update);
  connect(&simulation, &Simulation::bodyChanged, this, &RecordingActions::update);
  update();
}

void RecordingActions::update() {
  const bool isActive = simulation_.isActive() && simulation_.drawn();
  const bool isThere = recorder_.recording().has_value() && !recorder_.isRecording();
  record_->setVisible(simulation_.isActive());
  replay_->setVisible(simulation_.isActive());
  record_->setEnabled(isActive && !recorder_.isReplaying());
  const QSignalBlocker silent(record_);
  record_->setChecked(recorder_.isRecording());
  record_->setText(recorder_.isRecording() ? tr("Stop &recording") : tr("&Record"));
  record_->setToolTip((recorder_.isRecording()
                           ? tr("Recording all touches; press again to stop")
                           : tr("Record all touches, a thousand times a second")) +
                      " (" + record_->shortcut().toString(QKeySequence::NativeText) + ")");
  replay_->setEnabled(isActive && isThere);
  replay_->setText(recorder_.isReplaying() ? tr("Stop re&play") : tr("Re&play"));
  save_->setEnabled(isThere);
  open_->setEnabled(isActive && !recorder_.isRecording() && !recorder_.isReplaying());
  table_->setEnabled(isActive && isThere && !recorder_.isReplaying());
  series_->setEnabled(isActive && isThere && !recorder_.isReplaying());
  animation_->setEnabled(isActive && isThere && !recorder_.isReplaying());
}

void RecordingActions::toggleRecording(bool on) {
  if (on) {
    recorder_.start();
    workspace_.statusBar.showMessage(tr("Recording all touches; Ctrl+R or the button stops"));
    return;
  }
  recorder_.stop();
  workspace_.statusBar.clearMessage();
  if (!recorder_.recording()) {
    Q_EMIT workspace_.editor.said(tr("Nothing was recorded: nothing was touched"));
    return;
  }
  const app::TouchRecording& recording = *recorder_.recording();
  QString words = tr("Recorded %L1 s").arg(1e-3 * static_cast<double>(recording.steps), 0, 'f', 1);
  if (recording.isFull) words += tr("; the end was lost, it was too long");
  if (recording.modelChanges > 0)
    words += tr("; the solid was edited meanwhile, and a replay uses it as it is then");
  Q_EMIT workspace_.editor.said(words);
}

void RecordingActions::saveRecording() {
  const QString file =
      askFileToWrite(workspace_, tr("Save recording"), tr("Recordings (*.json)"), ".json");
  if (file.isEmpty()) return;
  app::RecordingFile kept{recorder_.recordedModel(), *recorder_.recording()};
  if (kept.model.name.empty()) kept.model.name = workspace_.editor.project().name;
  try {
    app::writeRecording(kept, file.toStdString());
    Q_EMIT workspace_.editor.said(tr("Recording saved to %1").arg(file));
  } catch (const modeling::ModelingError& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

void RecordingActions::openRecording() {
  const QString file = askFileToOpen(workspace_, tr("Open recording"), tr("Recordings (*.json)"));
  if (file.isEmpty()) return;
  try {
    app::RecordingFile opened = app::readRecording(file.toStdString());
    const std::string difference = app::differenceOf(
        opened.model,
        app::recordedModelOf(simulation_.body()->model(), workspace_.editor.project().name));
    QString words = tr("Opened a recording of %L1 s")
                        .arg(1e-3 * static_cast<double>(opened.recording.steps), 0, 'f', 1);
    if (!difference.empty()) words += "; " + QString::fromStdString(difference);
    recorder_.open(std::move(opened));
    Q_EMIT workspace_.editor.said(words);
  } catch (const modeling::ModelingError& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

void RecordingActions::exportTable() {
  const QString file =
      askFileToWrite(workspace_, tr("Export forces"), tr("Tables (*.csv)"), ".csv");
  if (file.isEmpty()) return;
  const auto body = simulation_.body();
  const app::TouchRecording recording = *recorder_.recording();
  writeInBackground(file, tr("Forces exported to %1").arg(file), [&](const Job& job) {
    Recorder::writeTable(body, recording, file.toStdString(), job);
  });
}

void RecordingActions::exportSeries() {
  const QString file = askFileToWrite(workspace_, tr("Export series"),
                                      tr("Series of meshes for ParaView (*.pvd)"), ".pvd");
  if (file.isEmpty()) return;
  const auto body = simulation_.body();
  const app::TouchRecording recording = *recorder_.recording();
  writeInBackground(file, tr("Series exported to %1").arg(file), [&](const Job& job) {
    Recorder::writeSeries(body, recording, file.toStdString(), job);
  });
}

void RecordingActions::writeInBackground(const QString& file, const QString& done,
                                         const std::function<void(const Job&)>& work) {
  try {
    if (runWorkInBackground(workspace_.window, tr("Exporting %1").arg(QFileInfo(file).fileName()),
                            work))
      Q_EMIT workspace_.editor.said(done);
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

std::size_t RecordingActions::drawInto(const std::filesystem::path& folder, const QSize& size) {
  simulation_.freeze();
  struct Live {
    Simulation& simulation;
    ~Live() { simulation.showLive(); }
  } const live{simulation_};
  const auto body = simulation_.body();
  const app::TouchRecording recording = *recorder_.recording();
  std::vector<app::TouchSnapshot> snapshots;
  std::uint64_t step = 0;
  const bool isPlayed =
      runWorkInBackground(workspace_.window, tr("Replaying"), [&](const Job& job) {
        app::replay(body, recording, job, [&](const app::TouchSnapshot& snapshot) {
          if (step++ % kStepsPerPicture == 0) snapshots.push_back(snapshot);
        });
      });
  if (!isPlayed) return 0;
  const bool isDrawn = runInSteps(workspace_.window, tr("Drawing the pictures"), snapshots.size(),
                                  [&](std::size_t k) {
                                    simulation_.show(snapshots[k]);
                                    workspace_.view.writePicture(folder / pictureName(k), size);
                                  });
  return isDrawn ? snapshots.size() : 0;
}

void RecordingActions::exportAnimation() {
  PictureDialog dialog(workspace_.view.size(), &workspace_.window);
  dialog.setWindowTitle(tr("Export animation"));
  if (dialog.exec() != QDialog::Accepted) return;
  const bool isVideo = !videoProgram().isEmpty();
  const QString target =
      isVideo ? askFileToWrite(workspace_, tr("Export animation"), tr("Videos (*.mp4)"), ".mp4")
              : QFileDialog::getExistingDirectory(&workspace_.window, tr("Folder for the pictures"),
                                                  workspace_.settings.lastFolder());
  if (target.isEmpty()) return;
  try {
    // Removed with its files, also after an error or a cancellation. Pictures are moved from there
    // when all are drawn.
    const QTemporaryDir pictures(isVideo ? QDir::tempPath() + "/palpa-XXXXXX"
                                         : target + "/.palpa-XXXXXX");
    if (!pictures.isValid())
      throw FileError(target.toStdString() + ": cannot be written (" +
                      pictures.errorString().toStdString() + ")");
    const std::filesystem::path folder = pictures.path().toStdString();
    const std::size_t count = drawInto(folder, dialog.pictureSize());
    if (count == 0) return;
    if (!isVideo)
      movePictures(folder, target.toStdString(), count);
    else if (!runWorkInBackground(workspace_.window, tr("Making the video"), [&](const Job& job) {
               makeVideo(folder, target.toStdString(), job);
             }))
      return;
    Q_EMIT workspace_.editor.said(
        isVideo
            ? tr("Animation exported to %1").arg(target)
            : tr("Pictures exported to %1; with ffmpeg installed they become a video").arg(target));
  } catch (const std::exception& error) {
    Q_EMIT workspace_.editor.refused(QString::fromStdString(error.what()));
  }
}

}  // namespace palpa::gui

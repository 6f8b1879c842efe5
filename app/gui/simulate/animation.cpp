#include "app/gui/simulate/animation.h"

#include <QCoreApplication>
#include <QProcess>
#include <QStandardPaths>
#include <cstdio>
#include <stdexcept>

namespace palpa::gui {
namespace {

constexpr const char* kPictures = "frame_%05d.png";
constexpr int kPatience = 50;  // ms between two checks of `isStopped`

}  // namespace

QString videoProgram() {
  return QStandardPaths::findExecutable("ffmpeg");
}

bool writeAnimation(Simulation& simulation, ViewportWidget& widget,
                    const std::vector<app::TouchSnapshot>& snapshots,
                    const std::filesystem::path& folder, const QSize& size,
                    const std::function<bool(double)>& isStopped) {
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    QCoreApplication::processEvents();
    if (isStopped(static_cast<double>(i) / static_cast<double>(snapshots.size()))) return false;
    simulation.show(snapshots[i]);
    char name[32];
    std::snprintf(name, sizeof name, kPictures, static_cast<int>(i));
    widget.writePicture(folder / name, size);
  }
  return true;
}

void makeVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
               const std::function<bool()>& isStopped) {
  QProcess program;
  program.setProcessChannelMode(QProcess::MergedChannels);
  // All players support even sizes and this pixel format.
  program.start(videoProgram(),
                {"-y", "-loglevel", "error", "-framerate", QString::number(kAnimationRate), "-i",
                 QString::fromStdString((folder / kPictures).string()), "-vf",
                 "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
                 QString::fromStdString(file.string())});
  while (!program.waitForFinished(kPatience) && program.state() != QProcess::NotRunning) {
    if (!isStopped()) continue;
    program.kill();
    program.waitForFinished();
    return;
  }
  if (program.exitStatus() != QProcess::NormalExit || program.exitCode() != 0)
    throw std::runtime_error(
        QCoreApplication::translate("Animation", "The video could not be made: %1")
            .arg(QString::fromLocal8Bit(program.readAll()).trimmed())
            .toStdString());
}

}  // namespace palpa::gui

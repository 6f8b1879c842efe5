#include "app/gui/simulate/animation.h"

#include <QCoreApplication>
#include <QProcess>
#include <QStandardPaths>
#include <cstdio>
#include <stdexcept>

#include "base/atomic_file.h"

namespace palpa::gui {
namespace {

constexpr const char* kPictures = "frame_%05d.png";
constexpr int kPatience = 50;  // ms between two checks for a cancellation

}  // namespace

QString videoProgram() {
  return QStandardPaths::findExecutable("ffmpeg");
}

std::filesystem::path pictureName(std::size_t number) {
  char name[32];
  std::snprintf(name, sizeof name, kPictures, static_cast<int>(number));
  return name;
}

void makeVideo(const std::filesystem::path& folder, const std::filesystem::path& file,
               const Job& job) {
  AtomicFile target(file);
  QProcess program;
  program.setProcessChannelMode(QProcess::MergedChannels);
  // All players support even sizes and this pixel format. The hidden file has no ending from which
  // the program could see the format.
  program.start(videoProgram(),
                {"-y", "-loglevel", "error", "-framerate", QString::number(kAnimationRate), "-i",
                 QString::fromStdString((folder / kPictures).string()), "-vf",
                 "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-f", "mp4",
                 QString::fromStdString(target.freshPath().string())});
  while (!program.waitForFinished(kPatience) && program.state() != QProcess::NotRunning) {
    if (!job.stop.stop_requested()) continue;
    program.kill();
    program.waitForFinished();
    throw Cancelled{};
  }
  if (program.exitStatus() != QProcess::NormalExit || program.exitCode() != 0)
    throw std::runtime_error(
        QCoreApplication::translate("Animation", "The video could not be made: %1")
            .arg(QString::fromLocal8Bit(program.readAll()).trimmed())
            .toStdString());
  target.commit();
}

void movePictures(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    std::error_code code;
    std::filesystem::rename(from / pictureName(k), to / pictureName(k), code);
    if (code)
      throw FileError((to / pictureName(k)).string() + ": cannot be written (" + code.message() +
                      ")");
  }
}

}  // namespace palpa::gui

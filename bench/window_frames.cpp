#include "bench/window_frames.h"

#include <QCoreApplication>
#include <QProcess>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace palpa::bench {
namespace {

constexpr double kGoal = 30;         // frames per second in a window
constexpr const char* kMark = "@@";  // begins the lines of printFrames()

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::string load() {
  std::string text;
  std::getline(std::ifstream("/proc/loadavg"), text, ' ');
  return text;
}

/// Numbers of all rounds of one program.
struct Rounds {
  std::vector<double> perSecond, view, processor;
};

using Table = std::map<std::string, Rounds>;  // by project, size and phase

/// Runs a program of this kind for one project and adds its rows; keys in the order of the rows.
void run(const QString& program, const std::filesystem::path& project, double seconds, Table& table,
         std::vector<std::string>& keys) {
  QProcess child;
  child.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  child.start(program, {"--frames-of", QString::fromStdString(project.string()), "--seconds",
                        QString::number(seconds)});
  if (!child.waitForFinished(600000) || child.exitCode() != 0)
    throw std::runtime_error(program.toStdString() + " cannot measure " + project.string());
  for (const QString& line : QString(child.readAllStandardOutput()).split('\n')) {
    const QStringList parts = line.split(';');
    if (parts.size() != 7 || parts[0] != kMark) continue;
    const std::string key = parts.mid(1, 3).join(';').toStdString();
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    Rounds& rounds = table[key];
    rounds.perSecond.push_back(parts[4].toDouble());
    rounds.view.push_back(parts[5].toDouble());
    rounds.processor.push_back(parts[6].toDouble());
  }
}

}  // namespace

std::vector<FrameRow> measureFrames(WindowDriver& driver, const std::filesystem::path& project,
                                    double seconds, const std::vector<QSize>& sizes) {
  driver.window().openFile(QString::fromStdString(project.string()));
  driver.waitForModel();
  std::vector<FrameRow> rows;
  for (const QSize& size : sizes) {
    driver.resize(size);
    const auto add = [&](const char* phase, const WindowDriver::Drag& drag) {
      rows.push_back({project.stem().string(),
                      std::to_string(size.width()) + "x" + std::to_string(size.height()), phase,
                      drag.framesPerSecond, drag.paintMilliseconds, drag.processorMilliseconds});
      driver.rest();
    };
    driver.orbit(0.3);
    driver.rest();
    add("orbit", driver.orbit(seconds));
    if (driver.hasControlPoints()) {  // no mesh body
      add("drag", driver.drag(seconds));
      driver.waitForModel();
    }
    driver.touch(1);  // columns of the place
    driver.rest();
    add("touch", driver.touch(seconds));
    add("orbit in Simulate", driver.orbit(seconds));
    driver.window().simulation().setActive(false);
    driver.rest();
  }
  return rows;
}

void printFrames(const std::vector<FrameRow>& rows) {
  for (const FrameRow& row : rows)
    std::printf("%s;%s;%s;%s;%.2f;%.2f;%.2f\n", kMark, row.project.c_str(), row.size.c_str(),
                row.phase.c_str(), row.perSecond, row.viewMilliseconds, row.processorMilliseconds);
}

int compareFrames(const std::vector<std::filesystem::path>& projects, double seconds, int rounds,
                  const std::string& other) {
  std::printf("medians of %d rounds; load %s\n", rounds, load().c_str());
  std::printf("%-18s %-10s %-18s %s\n", "project", "window", "phase",
              other.empty() ? "  1/s  view ms  processor ms"
                            : "  1/s  view ms  processor ms | other: the same");
  int missed = 0;
  for (const auto& project : projects) {
    Table own, others;
    std::vector<std::string> keys;
    for (int round = 0; round < rounds; ++round) {
      if (!other.empty()) run(QString::fromStdString(other), project, seconds, others, keys);
      run(QCoreApplication::applicationFilePath(), project, seconds, own, keys);
    }
    for (const std::string& key : keys) {
      std::istringstream parts(key);
      std::string name, size, phase;
      std::getline(parts, name, ';');
      std::getline(parts, size, ';');
      std::getline(parts, phase, ';');
      const auto print = [](const Rounds& of) {
        std::printf("%6.1f %7.1f %9.1f    ", median(of.perSecond), median(of.view),
                    median(of.processor));
      };
      std::printf("%-18s %-10s %-18s ", name.c_str(), size.c_str(), phase.c_str());
      print(own[key]);
      if (!other.empty()) {
        std::printf(" | ");
        print(others[key]);
      }
      const bool isMissed = median(own[key].perSecond) < kGoal;
      missed += isMissed;
      std::printf("%s\n", isMissed ? " missed" : "");
    }
    std::fflush(stdout);
  }
  std::printf("load %s; %d of the phases below %g frames per second\n", load().c_str(), missed,
              kGoal);
  return missed;
}

}  // namespace palpa::bench

// Times what a user of the window notices: start-up, an even event loop while models are rebuilt
// and control points dragged, frames per second, and how soon an opened or edited project can be
// touched. Needs an X display: scripts/with-display build/release/bin/palpa-window-bench.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/session/new_project.h"
#include "app/core/system/priority.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "bench/heartbeat.h"
#include "bench/latency_table.h"
#include "bench/window_driver.h"
#include "bench/window_export.h"
#include "bench/window_frames.h"
#include "modeling/shapes/primitives.h"

namespace {

using namespace palpa;
using bench::Heartbeat;
using bench::WindowDriver;

/// Seconds since this process was started, in steps of 10 ms.
double secondsSinceStart() {
  std::ifstream file("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  // The name of the program may hold blanks; after it, the start is the 20th number.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string field;
  for (int i = 0; i < 20; ++i) fields >> field;
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
         std::stod(field) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// What a started program prints: its first picture, and the first one of the file it was given.
int startUp(const std::string& file) {
  WindowDriver driver;
  std::printf("%.3f\n", secondsSinceStart());
  if (file.empty()) return 0;
  driver.window().begin({QString::fromStdString(file)});
  bool isPainted = false;
  QObject::connect(&driver.window().viewport(), &gui::ViewportWidget::framePainted,
                   [&] { isPainted = true; });
  bench::runUntil([&] { return isPainted; }, 60);
  std::printf("%.3f\n", secondsSinceStart());
  return 0;
}

struct Row {
  std::string what, unit;
  double value;
  std::optional<double> atMost, atLeast;
  bool isMissed() const { return (atMost && value > *atMost) || (atLeast && value < *atLeast); }
};

class Bench {
 public:
  explicit Bench(double seconds) : seconds_(seconds) {}

  void measureStart(const std::string& file) {
    for (const std::string& suffix : {std::string(", first time"), std::string(", again")}) {
      QProcess child;
      QStringList arguments{"--start-up"};
      if (!file.empty()) arguments << QString::fromStdString(file);
      child.start(QCoreApplication::applicationFilePath(), arguments);
      child.waitForFinished(120000);
      const QStringList times = QString(child.readAllStandardOutput()).split('\n');
      add("start to first picture" + suffix, "s", times.value(0).toDouble(), 2, {});
      if (!file.empty()) add("  to the picture of a file", "s", times.value(1).toDouble(), {}, {});
    }
  }

  /// The event loop while nothing happens, models are built, and control points are dragged.
  void measureHeartbeat(WindowDriver& driver, double edgeLength) {
    modeling::Project project = app::makeProject(modeling::makeSphere(25), "bench");
    project.mesh.edgeLength = edgeLength;
    driver.editor().start(std::move(project));
    driver.waitForModel();
    bench::runFor(1);
    const std::string nodes = ", n = " + std::to_string(driver.editor().model()->report().nodes);
    {
      const Heartbeat beat;
      bench::runFor(seconds_);
      addGaps("idle", beat.gaps(), {});
    }
    {
      const Heartbeat beat;
      double total = 0;
      constexpr int kRebuilds = 4;
      for (int i = 0; i < kRebuilds; ++i) {
        driver.editor().perform(modeling::MovePoints{
            modeling::PointSelection::of({0}), modeling::MoveBy{{0, 0, i % 2 ? -0.5 : 0.5}}, {}});
        total += driver.waitForModel();
      }
      bench::runFor(0.5);
      addGaps("rebuilds" + nodes, beat.gaps(), 50);
      add("  one rebuild", "s", total / kRebuilds, {}, {});
    }
    const Heartbeat beat;
    const auto drag = driver.drag(2 * seconds_);
    addGaps("dragging" + nodes, beat.gaps(), 50);
    addDrag(drag);
    add("  last edit to up to date", "s", driver.waitForModel(), {}, {});
  }

  void measureProject(WindowDriver& driver, const std::filesystem::path& file) {
    const std::string name = file.stem();
    const auto open = [&] {
      driver.window().openFile(QString::fromStdString(file.string()));
      return driver.waitForModel();
    };
    add(name + ": opened to touchable, empty cache", "s", open(), {}, {});
    // Stored when nothing else is to be done.
    bench::runFor(2);
    add("  filled cache", "s", open(), {}, {});
    const Heartbeat beat;
    const auto drag = driver.drag(seconds_);
    addDrag(drag);
    addGaps("  drag", beat.gaps(), 50);
    add("  last edit to up to date", "s", driver.waitForModel(), {}, {});
    measureTouch(driver);
  }

  /// Frames and the loop's answers while the surface is pulled around in Simulate mode.
  void measureTouch(WindowDriver& driver) {
    gui::Simulation& simulation = driver.window().simulation();
    driver.touch(1);  // columns of the place
    simulation.loop().clearLatency();
    const Heartbeat beat;
    const auto touch = driver.touch(seconds_);
    add("  frames of a touch", "1/s", touch.framesPerSecond, {}, 30);
    add("  to draw a frame in the view", "ms", touch.paintMilliseconds, {}, {});
    addGaps("  touch", beat.gaps(), {});
    const app::Latency latency = simulation.loop().latency();
    add("  input to force, 99 %", "ms", 1e3 * latency.p99, 1, {});
    add("  input to force, largest", "ms", 1e3 * latency.largest, {}, {});
    simulation.setActive(false);
  }

  /// Only a touch, for long: the sphere's surface is pulled around while it is drawn.
  void measureLongTouch(WindowDriver& driver, double edgeLength, double seconds) {
    modeling::Project project = app::makeProject(modeling::makeSphere(25), "bench");
    project.mesh.edgeLength = edgeLength;
    driver.editor().start(std::move(project));
    driver.waitForModel();
    add("touch of the sphere, n", "nodes", driver.editor().model()->report().nodes, {}, {});
    gui::Simulation& simulation = driver.window().simulation();
    driver.touch(1);
    // Two spans: columns are computed beside the first.
    for (const char* when : {"while columns are computed", "when they are there"}) {
      simulation.loop().clearLatency();
      const double begun = simulation.columns().columnsReady;
      const auto touch = driver.touch(seconds);
      const double ready = simulation.columns().columnsReady;
      add(std::string("touch ") + when + ": input to force, 99 %", "ms",
          1e3 * simulation.loop().latency().p99, 1, {});
      add("  columns at the beginning", "%", 100 * begun, {}, {});
      add("  columns at the end", "%", 100 * ready, {}, {});
      add("  frames", "1/s", touch.framesPerSecond, {}, 30);
      add("  steps", "1/s", simulation.snapshot().rate, {}, 1000);
      bench::printLatencies(simulation.loop().latencies());
      bench::runUntil([&] { return simulation.columns().columnsReady >= 1; }, 120);
    }
    simulation.setActive(false);
  }

  void writeJson(const std::string& file) const {
    QJsonArray rows;
    for (const Row& row : rows_) {
      QJsonObject object{{"what", QString::fromStdString(row.what)},
                         {"unit", QString::fromStdString(row.unit)},
                         {"value", row.value}};
      if (row.atMost) object["atMost"] = *row.atMost;
      if (row.atLeast) object["atLeast"] = *row.atLeast;
      rows.append(object);
    }
    QFile out(QString::fromStdString(file));
    const QByteArray text = QJsonDocument(rows).toJson();
    if (!out.open(QIODevice::WriteOnly) || out.write(text) != text.size())
      throw std::runtime_error("cannot write " + file);
  }

 private:
  void addDrag(const WindowDriver::Drag& drag) {
    add("  frames of a drag", "1/s", drag.framesPerSecond, {}, 30);
    add("  to handle a motion", "ms", drag.motionMilliseconds, {}, {});
    add("  to draw a frame in the view", "ms", drag.paintMilliseconds, {}, {});
  }

  void addGaps(const std::string& what, const Heartbeat::Gaps& gaps, std::optional<double> most) {
    add(what + ": largest gap of the event loop", "ms", gaps.largest, most, {});
    add("  99 % of the gaps are below", "ms", gaps.quantile99, {}, {});
    add("  gaps above 50 ms", "of " + std::to_string(gaps.beats), gaps.above50, {}, {});
  }

  void add(const std::string& what, const std::string& unit, double value,
           std::optional<double> atMost, std::optional<double> atLeast) {
    rows_.push_back({what, unit, value, atMost, atLeast});
    const Row& row = rows_.back();
    char goal[32] = "";
    if (atMost) std::snprintf(goal, sizeof goal, "<= %g", *atMost);
    if (atLeast) std::snprintf(goal, sizeof goal, ">= %g", *atLeast);
    std::printf("%-52s %8.*f %-9s %-7s%s\n", what.c_str(),
                unit == "s"      ? 2
                : unit[0] == 'o' ? 0
                                 : 1,
                value, unit.c_str(), goal, row.isMissed() ? " missed" : "");
    std::fflush(stdout);
  }

  double seconds_;
  std::vector<Row> rows_;
};

/// Projects of a folder and of its folder "design".
std::vector<std::filesystem::path> projectsIn(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& each : {folder, folder / "design"})
    if (each == folder || std::filesystem::is_directory(each))
      for (const auto& entry : std::filesystem::directory_iterator(each))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Times what a user of the window notices."};
  double seconds = 3;
  double edgeLength = 25 * std::numbers::pi / 2 / 22;  // about 2,500 nodes
  std::string json, folder = PALPA_PROJECTS;
  std::optional<std::string> started;
  bool withoutProjects = false;
  double touchSeconds = 0;
  options.add_option("--seconds", seconds, "each of the measured spans lasts");
  options.add_option("--edge-length", edgeLength, "mm, of the sphere (R = 25 mm) that is rebuilt");
  options.add_option("--projects", folder, "folder with the projects to open and drag");
  options.add_flag("--without-projects", withoutProjects, "only start-up and the sphere");
  options.add_option("--touch", touchSeconds,
                     "only a touch of the sphere with the view drawn, for so many seconds with a "
                     "histogram of the time from input to force");
  bool frames = false;
  bool exports = false;
  options.add_flag("--exports", exports,
                   "only the time to export the forces of a recorded touch of each project, "
                   "beside the time that was recorded");
  int rounds = 3;
  std::string against, framesOf, only;
  std::vector<int> windowSize;
  options.add_flag(
      "--frames", frames,
      "only frames per second of each project while the view orbits, a control point "
      "is dragged and the surface is touched, in windows of 1280 x 800 and 1600 x 1000");
  options.add_option("--against", against,
                     "with --frames: another build of this program, measured in alternation");
  options.add_option("--rounds", rounds, "with --frames: how often each is measured");
  options.add_option("--only", only, "projects whose names contain this");
  options.add_option("--frames-of", framesOf, "for the measurement in a separate process")
      ->group("");
  options.add_option("--window", windowSize, "with --frames-of: width and height")
      ->expected(2)
      ->group("");
  options.add_option("--json", json, "file for the numbers");
  options.add_option("--start-up", started, "for the measurement in a separate process")
      ->expected(0, 1)
      ->group("");
  CLI11_PARSE(options, argc, argv);

  // As the window's own program does.
  app::lowerPriorityOfLoadedThreads();
  QTemporaryDir own;  // settings, snapshots and cache
  if (!started && framesOf.empty()) {
    qputenv("XDG_STATE_HOME", own.path().toUtf8());
    qputenv("XDG_CACHE_HOME", own.path().toUtf8());
    qputenv("XDG_CONFIG_HOME", own.path().toUtf8());
  }
  palpa::gui::Application application(argc, argv);
  gui::applyTheme(application, gui::Settings().theme());
  try {
    if (started) return startUp(*started);
    if (!framesOf.empty()) {
      std::vector<QSize> sizes{{1280, 800}, {1600, 1000}};
      if (!windowSize.empty()) sizes = {{windowSize[0], windowSize[1]}};
      WindowDriver driver;
      bench::printFrames(bench::measureFrames(driver, framesOf, seconds, sizes));
      return 0;
    }
    auto files = projectsIn(folder);
    std::erase_if(files, [&](const auto& file) {
      return file.stem().string().find(only) == std::string::npos;
    });
    if (exports) {
      WindowDriver driver;
      for (const auto& file : files)
        bench::printExports(bench::measureExports(driver, file, seconds));
      return 0;
    }
    if (frames) {
      bench::compareFrames(files, seconds, rounds, against);
      return 0;
    }
    Bench bench(seconds);
    if (touchSeconds > 0) {
      WindowDriver driver;
      bench.measureLongTouch(driver, edgeLength, touchSeconds);
      if (!json.empty()) bench.writeJson(json);
      return 0;
    }
    bench.measureStart("");
    if (!files.empty()) bench.measureStart(files.back());
    WindowDriver driver;
    bench.measureHeartbeat(driver, edgeLength);
    if (!withoutProjects)
      for (const auto& file : files) bench.measureProject(driver, file);
    if (!json.empty()) bench.writeJson(json);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpa-window-bench: %s\n", error.what());
    return 1;
  }
  return 0;
}

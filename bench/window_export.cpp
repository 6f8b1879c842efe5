#include "bench/window_export.h"

#include <QAction>
#include <QTemporaryDir>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "app/gui/simulate/recorder.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

void writeForces(const std::shared_ptr<const app::TouchableModel>& body,
                 const app::TouchRecording& recording) {
  const QTemporaryDir folder;
  gui::Recorder::writeTable(body, recording, folder.filePath("forces.csv").toStdString(), Job{});
}

}  // namespace

std::vector<ExportRow> measureExports(WindowDriver& driver, const std::filesystem::path& project,
                                      double seconds) {
  driver.window().openFile(QString::fromStdString(project.string()));
  driver.waitForModel();
  gui::Simulation& simulation = driver.window().simulation();
  std::vector<ExportRow> rows;
  for (const char* tool : {"Grab", "Ball"}) {
    simulation.setActive(true);
    if (!runUntil([&] { return simulation.drawn() != nullptr; }, 60))
      throw std::runtime_error("Simulate mode does not begin");
    auto* action = driver.window().findChild<QAction*>(tool);
    if (!action) throw std::runtime_error(std::string("there is no tool ") + tool);
    action->trigger();
    simulation.loop().startRecording();
    driver.touch(seconds);
    const app::TouchRecording recording = simulation.loop().stopRecording();
    // The export alone: without the touch loop and its columns.
    const auto body = simulation.body();
    simulation.setActive(false);
    driver.rest();
    const auto fresh = std::make_shared<const app::TouchableModel>(body->sharedModel());
    ExportRow row{
        project.stem().string(), tool, 1e-3 * static_cast<double>(recording.steps), 0, 0, 0};
    row.wallSeconds = secondsFor([&] {
      row.processorSeconds = processorSecondsFor([&] { writeForces(fresh, recording); });
    });
    row.columnsThereSeconds = processorSecondsFor([&] { writeForces(fresh, recording); });
    rows.push_back(row);
  }
  return rows;
}

void printExports(const std::vector<ExportRow>& rows) {
  for (const ExportRow& row : rows) {
    std::printf(
        "%-18s %-5s recorded %5.2f s, exported in %6.2f s (processor %5.2f s%s; with columns %5.2f "
        "s)\n",
        row.project.c_str(), row.tool.c_str(), row.recordedSeconds, row.wallSeconds,
        row.processorSeconds, row.processorSeconds > row.recordedSeconds ? " missed" : "",
        row.columnsThereSeconds);
    std::fflush(stdout);
  }
}

}  // namespace palpa::bench

// A window opens project after project, touches each, and is itself closed and opened again now and
// then: memory, handles and threads must stay as they are.
#include <QAction>
#include <QApplication>
#include <QDir>
#include <QPixmapCache>
#include <QTemporaryDir>
#include <QTest>
#include <QThreadPool>
#include <array>
#include <cmath>
#include <memory>

#include "app/core/system/destroy_in_background.h"
#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "app/gui/window/main_window.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/shapes/primitives.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {
namespace {

constexpr int kPatience = 120'000;  // ms
constexpr int kLifetime = 6;        // of a window, in cycles

void writeFiles(const QDir& folder) {
  for (const char* name : {"sphere.json", "cylinder.json"})
    QFile::copy(QString(PALPA_PROJECTS "/") + name, folder.filePath(name));
  modeling::exportCad(modeling::makeBox({40, 30, 20}), folder.filePath("box.step").toStdString());
  QFile mesh(folder.filePath("tetrahedron.obj"));
  if (mesh.open(QIODevice::WriteOnly))
    mesh.write("v 0 0 0\nv 30 0 0\nv 0 30 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
}

/// Opens a file, waits for its model, presses on it in Simulate mode, and leaves the mode.
void cycle(Campaign& campaign, gui::MainWindow& window, const QString& file) {
  const std::string name = file.toStdString();
  if (!campaign.require(window.openFile(file), name + " is not opened")) return;
  gui::Editor& editor = window.editor();
  const auto isBuilt = [&] {
    return editor.rebuildStatus().state != app::RebuildStatus::State::kBuilding;
  };
  if (!campaign.require(QTest::qWaitFor(isBuilt, kPatience) && editor.model() != nullptr,
                        name + ": " + editor.rebuildStatus().error))
    return;
  window.simulation().setActive(true);
  gui::ViewportWidget& view = window.viewport();
  const auto isDrawn = [&] { return window.simulation().drawn() != nullptr; };
  campaign.require(QTest::qWaitFor(isDrawn, kPatience), name + " is not drawn");
  const QPoint middle = view.rect().center();
  QTest::mousePress(&view, Qt::LeftButton, {}, middle);
  for (int k = 1; k <= 5; ++k) {
    QTest::mouseMove(&view, middle + QPoint(4 * k, -3 * k));
    QTest::qWait(20);
  }
  QTest::mouseRelease(&view, Qt::LeftButton, {}, middle + QPoint(20, -15));
  window.simulation().setActive(false);
}

std::unique_ptr<gui::MainWindow> openWindow() {
  auto window = std::make_unique<gui::MainWindow>();
  window->show();
  (void)QTest::qWaitForWindowExposed(window.get());
  QApplication::setActiveWindow(window.get());
  return window;
}

/// Usage once the first model and all that is estimated of it are there, the fine picture is drawn,
/// and memory stands still; that takes long on a busy machine.
Usage usageAtRest(Campaign& campaign, gui::MainWindow& window) {
  constexpr double kStill = 0.1 * kMiB;
  constexpr int kStep = 500;  // ms
  const auto isDone = [&] {
    const app::RebuildStatus status = window.editor().rebuildStatus();
    return status.condition > 0 && status.touchError > 0;
  };
  campaign.require(QTest::qWaitFor(isDone, kPatience), "a new window's model is not complete");
  Usage usage;
  for (int still = 0, waited = 0; still < 4 && waited < kPatience; waited += kStep) {
    QTest::qWait(kStep);
    app::waitUntilDestroyed();
    // Qt keeps up to 10 MiB of pictures, which the icons of each new window go on filling.
    QPixmapCache::clear();
    const Usage now = usageNow();
    still = std::abs(now.heap - usage.heap) < kStill ? still + 1 : 0;
    usage = now;
  }
  return usage;
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("window_cycles", argc, argv, 0, 24);
  const QTemporaryDir scratch;
  for (const char* variable : {"HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"})
    qputenv(variable, scratch.path().toUtf8());
  qputenv("MESA_SHADER_CACHE_DISABLE", "true");
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, scratch.path());
  int one = 1;  // the campaign's options are none of Qt's
  palpa::gui::Application application(one, argv);
  QApplication::setQuitOnLastWindowClosed(false);
  // Threads of Qt's own pool, of which one or two are there as it happens, end before any are
  // counted.
  QThreadPool::globalInstance()->setExpiryTimeout(100);
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  const QDir folder(scratch.path());
  writeFiles(folder);
  constexpr std::array kNames{"sphere.json", "box.step", "cylinder.json", "tetrahedron.obj"};

  auto window = openWindow();
  Usage before;
  bool isWarm = false;
  long windows = 1;
  // Counted with a new window that has nothing open, so that both times the same is there.
  const auto count = [&] {
    window.reset();
    palpa::app::waitUntilDestroyed();
    window = openWindow();
    return usageAtRest(campaign, *window);
  };
  while (campaign.next()) {
    cycle(campaign, *window,
          folder.filePath(kNames[static_cast<std::size_t>(campaign.rounds()) % kNames.size()]));
    if (campaign.rounds() % kLifetime == 0) {
      window.reset();
      window = openWindow();
      ++windows;
    }
    if (isWarm || campaign.fraction() < 1.0 / 3) continue;
    before = count();
    isWarm = true;
  }
  const Usage after = count();
  campaign.figure("windows", static_cast<double>(windows));
  campaign.figures(before, after);
  campaign.requireFlat(before, after, 8 * kMiB);
  return campaign.end();
}

// A real window gets random mouse, key and menu input, and random answers to its dialogs. It must
// live on, and its project must stay one that can be saved and read. A parent process watches: when
// the window's process dies or stands still, the last actions are printed.
#include <signal.h>
#include <sys/wait.h>

#include <QAction>
#include <QApplication>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <chrono>
#include <cstdio>
#include <deque>
#include <fstream>
#include <thread>

#include "app/gui/base/appearance.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/reliability/campaign.h"
#include "tests/reliability/window_user.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// What there is to be opened and overwritten: examples, a mesh, a CAD file, a recording, and two
/// files that cannot be read.
void fillScratch(const fs::path& folder) {
  for (const char* name : {"sphere", "box", "cylinder", "fingertip-pad"})
    fs::copy_file(fs::path(PALPA_PROJECTS) / (std::string(name) + ".json"),
                  folder / (std::string(name) + ".json"));
  for (const auto& entry : fs::directory_iterator(fs::path(PALPA_TEST_DATA) / "recordings"))
    if (entry.is_regular_file()) fs::copy_file(entry.path(), folder / entry.path().filename());
  modeling::exportCad(modeling::makeCylinder(15, 30), folder / "part.step");
  std::ofstream(folder / "tetrahedron.obj")
      << "v 0 0 0\nv 30 0 0\nv 0 30 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  std::ofstream(folder / "broken.json") << "{\"palpa\": 2, \"solid\": ";
  std::ofstream(folder / "broken.stl") << "solid\nfacet normal 0 0\n";
}

/// All that the program writes by itself stays in the scratch folder.
void confine(const QString& folder) {
  for (const char* name :
       {"HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "TMPDIR"})
    qputenv(name, folder.toUtf8());
  qputenv("MESA_SHADER_CACHE_DISABLE", "true");
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, folder);
  fs::current_path(folder.toStdString());
}

/// Writes each action at once, so that the last one is there after a crash.
class Log {
 public:
  explicit Log(const std::string& path) : file_(path) {}
  void operator()(const QString& line) { file_ << line.toStdString() << std::endl; }

 private:
  std::ofstream file_;
};

/// The saved text must be readable, and all steps back and forth must lead to it again.
void check(Campaign& campaign, gui::Editor& editor) {
  const std::string text = modeling::toJson(editor.project());
  try {
    campaign.require(modeling::toJson(modeling::parseProject(text, "project")) == text,
                     "the project changes when it is saved and read");
  } catch (const std::exception& error) {
    campaign.fail("the project cannot be read again: " + std::string(error.what()));
  }
  const auto& document = editor.session().document();
  if (document.isInGroup()) return;
  const std::size_t position = document.history().position;
  while (document.canUndo()) editor.undo();
  while (document.history().position < position) editor.redo();
  // How the window shows the project is no step and stays as it is.
  campaign.require(modeling::toJson(editor.project()) == text, "undo and redo lead elsewhere");
}

/// The window's process.
int drive(Campaign& campaign, int argc, char** argv, const QString& folder,
          const std::string& log) {
  confine(folder);
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  QApplication application(argc, argv);
  QApplication::setQuitOnLastWindowClosed(false);
  gui::applyTheme(application, gui::Theme::kLight);
  Log write(log);
  WindowUser user(campaign.seed(), folder, std::ref(write));
  Usage before;
  bool isWarm = false;
  while (campaign.next()) {
    user.act();
    QTest::qWait(pick(user.random(), 0, 6));
    if (campaign.rounds() % 200 == 0) {
      user.rest();
      check(campaign, user.window().editor());
    }
    if (isWarm || campaign.fraction() < 1.0 / 3) continue;
    before = usageNow();
    isWarm = true;
  }
  user.rest();
  check(campaign, user.window().editor());
  const Usage after = usageNow();
  for (const auto& [name, count] : user.counts()) campaign.figure(name, static_cast<double>(count));
  campaign.figures(before, after);
  return campaign.end();
}

/// Waits for the window's process: its exit code, or -1 when it crashed or did nothing for `most`.
int watch(pid_t child, const std::string& log, std::chrono::seconds most) {
  auto last = Clock::now();
  std::uintmax_t size = 0;
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::error_code none;
    const std::uintmax_t now = fs::file_size(log, none);
    if (!none && now != size) {
      size = now;
      last = Clock::now();
    }
    if (Clock::now() - last > most) {
      std::fprintf(stderr, "random_window: nothing happens any more\n");
      ::kill(child, SIGABRT);
      ::waitpid(child, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(50ms);
  }
}

void printEnd(const std::string& log) {
  std::ifstream file(log);
  std::deque<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
    if (lines.size() > 40) lines.pop_front();
  }
  for (const std::string& line : lines) std::fprintf(stderr, "  %s\n", line.c_str());
}

}  // namespace
}  // namespace palpa::reliability

int main(int argc, char** argv) {
  using namespace palpa::reliability;
  Campaign campaign("random_window", argc, argv, 12, 0, {"--log"});
  const QTemporaryDir folder;
  const std::string log =
      campaign.option("--log").value_or(folder.filePath("actions.log").toStdString());
  QDir().mkdir(folder.filePath("files"));
  fillScratch(folder.filePath("files").toStdString());
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    int one = 1;  // the campaign's options are none of Qt's
    const int result = drive(campaign, one, argv, folder.filePath("files"), log);
    std::fflush(nullptr);
    return result;
  }
  const int result = watch(child, log, 240s);
  if (result == 0) return 0;
  std::fprintf(stderr, "random_window: the last actions, seed %llu:\n",
               static_cast<unsigned long long>(campaign.seed()));
  printEnd(log);
  if (result > 0) return result;
  campaign.fail("the window's process crashed or stood still");
  return campaign.end();
}

#include "tests/reliability/window_process.h"

#include <signal.h>
#include <sys/wait.h>

#include <QFile>
#include <QSettings>
#include <QTemporaryDir>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <thread>

#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// Longest time in which nothing is logged: the longest wait of an action, with room to spare.
/// Sanitizers make the models up to ten times slower.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::chrono::seconds kMaxStandstill = 20min;
#else
constexpr std::chrono::seconds kMaxStandstill = 4min;
#endif

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

/// Prints where the threads of a process are. Needs gdb.
void printThreads(pid_t process) {
  const std::string command = "timeout 120 gdb -nx -batch -p " + std::to_string(process) +
                              " -ex 'thread apply all backtrace' >&2 2>/dev/null";
  std::fflush(nullptr);
  if (std::system(command.c_str()) != 0)
    std::fprintf(stderr, "gdb, which is not installed, would print where its threads are\n");
}

/// Waits for the window's process: its exit code, or -1 when it crashed or stood still.
int watch(pid_t child, const std::string& log) {
  auto last = Clock::now();
  std::uintmax_t size = 0;
  for (;;) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) {
      if (WIFEXITED(status)) return WEXITSTATUS(status);
      std::fprintf(stderr, "the window's process ended by signal %d (%s)\n", WTERMSIG(status),
                   ::strsignal(WTERMSIG(status)));
      return -1;
    }
    std::error_code none;
    const std::uintmax_t now = fs::file_size(log, none);
    if (!none && now != size) {
      size = now;
      last = Clock::now();
    }
    if (Clock::now() - last > kMaxStandstill) {
      std::fprintf(stderr, "nothing happens any more\n");
      printThreads(child);
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

/// The window's process.
int runWindow(const QString& folder, const std::string& log, char** argv,
              const WindowProcess& drive) {
  confine(folder);
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  int one = 1;  // the campaign's options are none of Qt's
  gui::Application application(one, argv);
  QApplication::setQuitOnLastWindowClosed(false);
  gui::applyTheme(application, gui::Theme::kLight);
  std::ofstream file(log);
  return drive(folder, [&file](const QString& line) { file << line.toStdString() << std::endl; });
}

}  // namespace

int runWatched(Campaign& campaign, char** argv, const WindowProcess& drive) {
  const QTemporaryDir folder;
  const std::string log =
      campaign.option("--log").value_or(folder.filePath("actions.log").toStdString());
  QDir().mkdir(folder.filePath("files"));
  fillScratch(folder.filePath("files").toStdString());
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int result = runWindow(folder.filePath("files"), log, argv, drive);
    std::fflush(nullptr);
    std::exit(result);
  }
  const int result = watch(child, log);
  if (result == 0) return 0;
  std::fprintf(stderr, "the last actions, seed %llu:\n",
               static_cast<unsigned long long>(campaign.seed()));
  printEnd(log);
  if (result > 0) return result;
  campaign.fail("the window's process crashed or stood still");
  return campaign.end();
}

void checkProject(Campaign& campaign, gui::Editor& editor) {
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

}  // namespace palpa::reliability

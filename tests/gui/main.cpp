#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>
#include <QWidget>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <thread>

#include "app/gui/base/appearance.h"
#include "app/gui/base/application.h"

namespace {

/// Ends the program if a test takes too long, and prints the names of the test and of an open modal
/// dialog, which would wait for ever.
class Watchdog : public testing::EmptyTestEventListener {
 public:
  Watchdog() : thread_([this](const std::stop_token& stop) { watch(stop); }) {}

  void OnTestStart(const testing::TestInfo& test) override {
    note(std::string(test.test_suite_name()) + "." + test.name());
  }
  void OnTestEnd(const testing::TestInfo&) override { note({}); }

 private:
  static constexpr std::chrono::seconds kMaxTestTime{100};

  void note(const std::string& test) {
    const std::lock_guard lock(mutex_);
    test_ = test;
    ++count_;
    changed_.notify_all();
  }

  void watch(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      const int count = count_;
      if (changed_.wait_for(lock, stop, kMaxTestTime, [&] { return count_ != count; }) ||
          stop.stop_requested() || test_.empty())
        continue;
      std::cerr << test_ << " does not end.";
      // Called from another thread; harmless, as the program ends here.
      if (const QWidget* modal = QApplication::activeModalWidget())
        std::cerr << " Open: " << modal->metaObject()->className() << " \""
                  << modal->windowTitle().toStdString() << '"';
      std::cerr << std::endl;
      std::abort();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string test_;
  int count_ = 0;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();  // needs no display
  // Models and shaders that one test stores are read by the next ones, not computed and compiled
  // again. ctest names a folder that all suites share.
  const QTemporaryDir temporary;
  const QByteArray cache = qEnvironmentVariable("PALPA_TEST_CACHE", temporary.path()).toUtf8();
  qputenv("XDG_CACHE_HOME", cache);
  qputenv("MESA_SHADER_CACHE_DIR", cache);
  // Tests cannot find native dialogs of the desktop.
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  palpa::gui::Application application(argc, argv);
  palpa::gui::applyTheme(application, palpa::gui::Theme::kLight);
  testing::UnitTest::GetInstance()->listeners().Append(new Watchdog);
  return RUN_ALL_TESTS();
}

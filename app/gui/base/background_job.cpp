#include "app/gui/base/background_job.h"

#include <QApplication>
#include <QEventLoop>
#include <QPointer>
#include <QTimer>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/gui/base/progress_dialog.h"

namespace palpa::gui {
namespace {

constexpr int kPatience = 400;  // ms until the dialog appears
constexpr int kRefresh = 50;    // ms between two updates of the progress

// Only the window's thread uses them.
std::stop_source* running_ = nullptr;  // of the running job
QPointer<QWidget> closing_;            // to be closed after it

/// State that the worker reports to the window.
struct Shared {
  std::mutex mutex;
  std::string phase;
  double fraction = 0;
  bool isDone = false;
};

/// The time during which a job runs. Ends also after an exception.
struct Registration {
  explicit Registration(std::stop_source& stop) { running_ = &stop; }
  ~Registration() {
    running_ = nullptr;
    // Later: the functions that started the job are still being left.
    if (QWidget* window = std::exchange(closing_, nullptr))
      QMetaObject::invokeMethod(window, &QWidget::close, Qt::QueuedConnection);
  }
};

}  // namespace

bool isBackgroundJobRunning() {
  return running_ != nullptr;
}

void cancelBackgroundJob() {
  if (running_) running_->request_stop();
}

void closeAfterBackgroundJob(QWidget& window) {
  if (!running_) return;
  running_->request_stop();
  closing_ = &window;
}

bool runWorkInBackground(QWidget& window, const QString& title, const BackgroundWork& work) {
  if (running_) throw std::logic_error("runWorkInBackground: another job is running");
  std::stop_source stop;
  const Registration registration(stop);
  Shared shared;
  std::exception_ptr failure;
  QEventLoop loop;

  Job job;
  job.stop = stop.get_token();
  job.progress = [&shared](Phase phase, double fraction) {
    const std::lock_guard lock(shared.mutex);
    shared.phase = nameOf(phase);
    shared.fraction = fraction;
  };
  std::jthread worker([&] {
    try {
      work(job);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(shared.mutex);
    shared.isDone = true;
    QMetaObject::invokeMethod(&loop, &QEventLoop::quit, Qt::QueuedConnection);
  });
  const auto isDone = [&] {
    const std::lock_guard lock(shared.mutex);
    return shared.isDone;
  };

  // Input that arrives before the dialog waits: most jobs end within this time.
  QApplication::setOverrideCursor(Qt::BusyCursor);
  QTimer patience;
  patience.setSingleShot(true);
  QObject::connect(&patience, &QTimer::timeout, &loop, &QEventLoop::quit);
  patience.start(kPatience);
  while (!isDone() && patience.isActive()) loop.exec(QEventLoop::ExcludeUserInputEvents);
  QApplication::restoreOverrideCursor();

  if (!isDone()) {
    ProgressDialog dialog(title, &window);
    QObject::connect(&dialog, &QDialog::rejected, &dialog, [&stop] { stop.request_stop(); });
    QTimer refresh;
    QObject::connect(&refresh, &QTimer::timeout, &dialog, [&] {
      const std::lock_guard lock(shared.mutex);
      dialog.showProgress(QString::fromStdString(shared.phase), shared.fraction,
                          stop.stop_requested());
    });
    refresh.start(kRefresh);
    dialog.open();
    while (!isDone()) loop.exec();
  }
  worker.join();
  if (failure) {
    try {
      std::rethrow_exception(failure);
    } catch (const Cancelled&) {
      return false;
    }
  }
  return !stop.stop_requested();
}

bool runInSteps(QWidget& window, const QString& title, std::size_t count,
                const std::function<void(std::size_t)>& step) {
  if (running_) throw std::logic_error("runInSteps: another job is running");
  std::stop_source stop;
  const Registration registration(stop);
  ProgressDialog dialog(title, &window);
  QObject::connect(&dialog, &QDialog::rejected, &dialog, [&stop] { stop.request_stop(); });
  dialog.open();
  for (std::size_t k = 0; k < count; ++k) {
    const double done = static_cast<double>(k) / static_cast<double>(count);
    dialog.showProgress(
        QCoreApplication::translate("BackgroundJob", "%1 of %2").arg(k + 1).arg(count), done,
        stop.stop_requested());
    QCoreApplication::processEvents();
    if (stop.stop_requested()) return false;
    step(k);
  }
  return true;
}

}  // namespace palpa::gui

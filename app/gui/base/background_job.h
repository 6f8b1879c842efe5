#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <type_traits>

#include "base/job.h"

// Long operations outside the window's thread.
namespace palpa::gui {

using BackgroundWork = std::function<void(const Job&)>;

/// Runs `work` on a separate thread and returns after its end. Meanwhile the window is drawn and
/// its timers run, but it accepts no input; after 0.4 s a dialog shows `title`, the phase, the
/// fraction and a Cancel button. Rethrows exceptions of `work`.
///
/// False if the user cancelled: `work` was asked to stop, and the caller must discard its result.
/// There is one job at a time; throws std::logic_error for a second one.
bool runWorkInBackground(QWidget& window, const QString& title, const BackgroundWork& work);

/// Runs work that needs the window's thread in `count` steps, with the same dialog and the same
/// rules; returns false if the user cancelled. Events are processed between the steps; exceptions
/// of `step` pass through.
bool runInSteps(QWidget& window, const QString& title, std::size_t count,
                const std::function<void(std::size_t)>& step);

/// True while a job is running.
bool isBackgroundJobRunning();

/// Asks the running job to stop, as the Cancel button does. Does nothing without a job.
void cancelBackgroundJob();

/// The same, and closes `window` in the first turn of the event loop after the job has ended. May
/// be called again meanwhile.
void closeAfterBackgroundJob(QWidget& window);

/// The same for work with a result; nothing if the user cancelled.
template <class Work>
auto runInBackground(QWidget& window, const QString& title, const Work& work)
    -> std::optional<std::invoke_result_t<Work, const Job&>> {
  std::optional<std::invoke_result_t<Work, const Job&>> result;
  const bool isDone =
      runWorkInBackground(window, title, [&](const Job& job) { result.emplace(work(job)); });
  if (!isDone) result.reset();
  return result;
}

}  // namespace palpa::gui

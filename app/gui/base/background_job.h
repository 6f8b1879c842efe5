#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <type_traits>

#include "base/job.h"

// Long operations away from the thread of the window.
namespace palpa::gui {

using BackgroundWork = std::function<void(const Job&)>;

/// Runs `work` on a thread of its own and returns when it has ended. Meanwhile the window is drawn
/// and its timers run, but it takes no input; after 0.4 s a dialog with `title`, the phase, the
/// fraction and a Cancel button stands over it. What `work` throws is thrown here.
///
/// False when the person cancelled: `work` was asked to stop, and what it may have finished all the
/// same is to be dropped. One at a time; std::logic_error for a second one.
bool runWorkInBackground(QWidget& window, const QString& title, const BackgroundWork& work);

/// Is such an operation running?
bool isBackgroundJobRunning();

/// Asks the running operation, if any, to stop; it ends as if the person had cancelled.
void cancelBackgroundJob();

/// The same for work with a result; nothing when the person cancelled.
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

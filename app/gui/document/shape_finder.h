#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "app/core/design/shape_search.h"
#include "base/worker_thread.h"

namespace palpa::gui {

class Editor;

/// Search for a shape that meets the design of the project, in the background. It works on a copy:
/// the project changes only by accept(). An edit that changes the problem ends a running search; a
/// found shape stays and fits again once the edit is undone.
class ShapeFinder : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kIdle,
    kSearching,
    kStopping,  ///< cancelled; the thread ends its work
    kFound,     ///< result() waits for accept() or discard()
  };

  explicit ShapeFinder(Editor& editor);
  ~ShapeFinder() override;

  /// Why no search can begin, as a sentence that names the place; empty if one can. Cheap.
  QString obstacle() const;
  /// The same for what needs the control points: the selection and the mirror planes. Takes
  /// milliseconds.
  QString obstacleOfPoints() const;

  /// Begins a search; does nothing with an obstacle() or while one runs.
  void start();
  /// Ends a running search; the project and message() then say so. Does not wait.
  void cancel();
  State state() const { return state_; }
  bool isSearching() const { return state_ == State::kSearching || state_ == State::kStopping; }

  /// Of the search that runs or has found a shape.
  const modeling::Design& design() const { return design_; }
  /// Shapes computed so far; the first one is the project as it was.
  const std::vector<app::ShapeStep>& steps() const { return steps_; }
  double progress() const { return progress_; }
  /// Requires State::kFound.
  const app::ShapeResult& result() const { return *result_; }
  /// True if the project has changed since the search began, so that the result does not fit.
  bool isOutdated() const { return isOutdated_; }

  /// Takes the found shape: one step of undo. False if it does not fit any more.
  bool accept();
  /// Drops the found shape; the project stays as it is.
  void discard();

  /// How the last search ended without a shape, as sentences; empty: nothing to say.
  const QString& message() const { return message_; }

 Q_SIGNALS:
  /// Any of the above changed.
  void changed();

 private:
  void projectChanged(const modeling::Change& change);
  void leave();
  void stop(const QString& why);
  void finish(std::optional<app::ShapeResult> result, const QString& problem);
  void forgetResult();

  Editor& editor_;
  State state_ = State::kIdle;
  std::shared_ptr<const modeling::Project> project_;  // searched
  modeling::Design design_;
  std::vector<app::ShapeStep> steps_;
  double progress_ = 0;
  std::optional<app::ShapeResult> result_;
  bool isOutdated_ = false;
  QString message_;
  std::uint64_t number_ = 0;  // of the search; reports of earlier ones are dropped
  WorkerThread worker_;       // last: its tasks call this object
};

}  // namespace palpa::gui

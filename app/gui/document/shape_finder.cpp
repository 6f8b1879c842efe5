#include "app/gui/document/shape_finder.h"

#include <QMetaObject>
#include <new>

#include "app/core/design/design_space.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/system/priority.h"
#include "app/gui/document/design_edit.h"
#include "app/gui/document/design_words.h"
#include "app/gui/document/editor.h"
#include "base/error.h"

namespace palpa::gui {
namespace {

constexpr double kBytesPerGiB = 1024.0 * 1024.0 * 1024.0;

/// True if a change makes another problem of the search: another body, other touches, …
bool changesProblem(const modeling::Change& change) {
  return change.topology || change.edges || !change.movedPoints.empty() || change.patchNames ||
         change.material || change.supports || change.loads || change.touches || change.mesh;
}

}  // namespace

ShapeFinder::ShapeFinder(Editor& editor)
    : QObject(&editor), editor_(editor), worker_(app::lowerThreadPriority) {
  connect(&editor, &Editor::projectChanged, this, &ShapeFinder::projectChanged);
  connect(&editor, &Editor::aboutToReplace, this, &ShapeFinder::leave);
}

ShapeFinder::~ShapeFinder() = default;

QString ShapeFinder::obstacle() const {
  const modeling::Project& project = editor_.project();
  if (const std::string reason = app::gradientObstacle(project); !reason.empty())
    return sentence(QString::fromStdString(reason));
  if (project.touches.empty())
    return tr(
        "The project has no touches. Add one with Place touch (T), or store an exact touch in "
        "Simulate mode (F5).");
  const modeling::Design design = designOf(project);
  if (design.targets.empty())
    return tr("There is no target yet: add the touch that should feel different.");
  try {
    app::validateDesign(project, design);
  } catch (const Error& error) {
    return designProblem(QString::fromStdString(error.what()), design);
  }
  return {};
}

QString ShapeFinder::obstacleOfPoints() const {
  if (!editor_.solid()) return {};
  const modeling::Design design = designOf(editor_.project());
  try {
    const app::DesignSpace space(editor_.project(), design);
  } catch (const Error& error) {
    return designProblem(QString::fromStdString(error.what()), design);
  }
  return {};
}

void ShapeFinder::start() {
  if (isSearching() || !obstacle().isEmpty()) return;
  forgetResult();
  message_.clear();
  steps_.clear();
  progress_ = 0;
  isOutdated_ = false;
  project_ = std::make_shared<const modeling::Project>(editor_.project());
  design_ = designOf(*project_);
  state_ = State::kSearching;
  const std::uint64_t number = ++number_;
  app::ShapeSearchOptions options;
  options.build.memoryLimit = editor_.settings().memoryLimitGiB() * kBytesPerGiB;
  worker_.replace([this, number, options, project = project_, design = design_,
                   threads = editor_.settings().threads()](const std::stop_token& stop) mutable {
    // Reports of earlier searches arrive after the next one has begun.
    const auto report = [this, number](auto act) {
      QMetaObject::invokeMethod(
          this,
          [this, number, act = std::move(act)]() mutable {
            if (number == number_) act();
          },
          Qt::QueuedConnection);
    };
    options.onStep = [&](const app::ShapeStep& step) {
      report([this, step] {
        steps_.push_back(step);
        Q_EMIT changed();
      });
    };
    Job job;
    job.stop = stop;
    job.threads = threads;
    job.progress = [&](Phase, double done) {
      report([this, done] {
        progress_ = done;
        Q_EMIT changed();
      });
    };
    auto result = std::make_shared<std::optional<app::ShapeResult>>();
    QString problem;
    try {
      result->emplace(app::findShape(*project, design, options, job));
    } catch (const Cancelled&) {
      // stop() has the reason.
    } catch (const std::bad_alloc&) {
      problem =
          tr("There is not enough memory for the search. Close other programs, or ask for "
             "less accuracy in Properties of Mesh.");
    } catch (const Error& error) {
      problem = designProblem(QString::fromStdString(error.what()), design);
    }
    report([this, result, problem] { finish(std::move(*result), problem); });
  });
  Q_EMIT changed();
}

void ShapeFinder::cancel() {
  const int count = steps_.empty() ? 0 : steps_.back().number;
  stop(count == 0 ? tr("The search was stopped; the project is as it was.")
       : count == 1
           ? tr("The search was stopped after one step; the project is as it was.")
           : tr("The search was stopped after %1 steps; the project is as it was.").arg(count));
}

void ShapeFinder::stop(const QString& why) {
  if (state_ != State::kSearching) return;
  message_ = why;
  state_ = State::kStopping;
  // A search that the thread has not begun yet is dropped without a report: this one comes always.
  worker_.replace([this, number = number_](const std::stop_token&) {
    QMetaObject::invokeMethod(
        this,
        [this, number] {
          if (number == number_ && state_ == State::kStopping) finish(std::nullopt, {});
        },
        Qt::QueuedConnection);
  });
  Q_EMIT changed();
}

void ShapeFinder::finish(std::optional<app::ShapeResult> result, const QString& problem) {
  // A result that arrives after a cancellation is dropped.
  if (state_ == State::kSearching) {
    message_ = problem;
    if (result && result->commands.empty()) {
      message_ = result->isReached
                     ? tr("The present shape meets all targets already: nothing has to move.")
                     : tr("No other shape comes nearer to the targets than the present one. What "
                          "limits it: %1.")
                           .arg(limitsText(result->limits));
      result.reset();
    }
    result_ = std::move(result);
  }
  state_ = result_ ? State::kFound : State::kIdle;
  Q_EMIT changed();
}

void ShapeFinder::projectChanged(const modeling::Change& change) {
  const bool isOther = changesProblem(change);
  if (state_ == State::kSearching && (isOther || change.design))
    stop(
        tr("The search has ended because the project was changed. Find begins again from its "
           "present shape."));
  if (state_ == State::kFound && isOther)
    isOutdated_ = changesProblem(modeling::compare(*project_, editor_.project()));
  if (state_ == State::kIdle && (isOther || change.design)) message_.clear();
  Q_EMIT changed();
}

bool ShapeFinder::accept() {
  if (state_ != State::kFound || isOutdated_) return false;
  // The edits must not outdate the result.
  state_ = State::kIdle;
  const bool isDone = editor_.performAll(tr("Find a shape"), result_->commands);
  if (isDone)
    forgetResult();
  else
    state_ = State::kFound;
  Q_EMIT changed();
  return isDone;
}

void ShapeFinder::discard() {
  if (state_ != State::kFound) return;
  forgetResult();
  state_ = State::kIdle;
  Q_EMIT changed();
}

void ShapeFinder::forgetResult() {
  result_.reset();
  project_.reset();
  isOutdated_ = false;
}

void ShapeFinder::leave() {
  ++number_;
  worker_.cancel();
  forgetResult();
  steps_.clear();
  message_.clear();
  state_ = State::kIdle;
  Q_EMIT changed();
}

}  // namespace palpa::gui

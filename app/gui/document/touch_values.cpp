#include "app/gui/document/touch_values.h"

#include <QMetaObject>
#include <algorithm>
#include <new>

#include "app/core/design/target_values.h"
#include "app/core/system/destroy_in_background.h"
#include "app/core/system/priority.h"
#include "app/gui/document/editor.h"
#include "base/error.h"

namespace palpa::gui {
namespace {

using modeling::DesignTarget;

/// True if two targets ask for the same value.
bool asksTheSame(const DesignTarget& a, const DesignTarget& b) {
  return a.touch == b.touch && a.kind == b.kind && a.depth == b.depth;
}

}  // namespace

TouchValues::TouchValues(Editor& editor)
    : QObject(&editor), editor_(editor), worker_(app::lowerThreadPriority) {
  connect(&editor, &Editor::rebuildChanged, this, &TouchValues::update);
  connect(&editor, &Editor::projectChanged, this, [this](const modeling::Change& change) {
    if (change.design || change.touches || change.body()) update();
  });
  connect(&editor, &Editor::aboutToReplace, this, &TouchValues::forget);
}

TouchValues::~TouchValues() = default;

void TouchValues::setShown(bool shown) {
  if (shown == isShown_) return;
  isShown_ = shown;
  if (shown)
    update();
  else
    forget();
}

TouchValues::Input TouchValues::present() const {
  Input input;
  const app::RebuildStatus status = editor_.rebuildStatus();
  const auto model = editor_.model();
  if (!model || status.modelRevision != status.revision || model->report().residual) return input;
  input.model = model;
  input.touches = editor_.project().touches;
  // A touch can become a target at any time: its stiffness and its force cost nothing more.
  for (const modeling::Touch& touch : input.touches)
    for (const auto kind : {DesignTarget::Kind::kStiffness, DesignTarget::Kind::kForce})
      input.targets.push_back({touch.name, kind, 1.0, {}, 1.0});
  if (editor_.project().design)
    for (const DesignTarget& target : editor_.project().design->targets)
      if (target.depth)
        input.targets.push_back({target.touch, target.kind, 1.0, target.depth, 1.0});
  return input;
}

void TouchValues::update() {
  if (!isShown_) return;
  Input input = present();
  if (!input.model || input == asked_) return;
  if (input.touches.empty()) {
    forget();
    return;
  }
  asked_ = input;
  const std::uint64_t number = ++number_;
  auto project = std::make_shared<const modeling::Project>(editor_.project());
  worker_.replace([this, number, input = std::move(input), project](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    job.threads = 1;
    std::vector<Value> values;
    QString problem;
    try {
      const auto found = app::targetValues(*project, *input.model, input.targets, job);
      for (std::size_t i = 0; i < found.size(); ++i)
        values.push_back({input.targets[i], found[i].value});
    } catch (const Cancelled&) {
      return;  // a newer request
    } catch (const std::bad_alloc&) {
      problem = tr("There is not enough memory to play the touches.");
    } catch (const Error& error) {
      problem = QString::fromStdString(error.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, number, values = std::move(values), problem] { receive(number, values, problem); },
        Qt::QueuedConnection);
  });
}

void TouchValues::receive(std::uint64_t number, std::vector<Value> values, const QString& problem) {
  if (number != number_) return;
  values_ = std::move(values);
  problem_ = problem;
  Q_EMIT changed();
}

void TouchValues::forget() {
  ++number_;
  worker_.cancel();
  if (asked_.model) app::destroyInBackground(std::move(asked_.model));
  asked_ = {};
  values_.clear();
  problem_.clear();
  Q_EMIT changed();
}

std::optional<double> TouchValues::of(const DesignTarget& target) const {
  const auto found = std::find_if(values_.begin(), values_.end(), [&](const Value& value) {
    return asksTheSame(value.target, target);
  });
  if (found == values_.end() || !(found->value > 0)) return std::nullopt;
  return found->value;
}

}  // namespace palpa::gui

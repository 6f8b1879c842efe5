#include "app/gui/window/failure_notice.h"

#include <utility>

#include "app/gui/document/rebuild_words.h"
#include "app/gui/document/remedies.h"

namespace palpa::gui {
namespace {

constexpr int kDelay = 1000;  // ms: ignores short failures during a drag

using State = app::RebuildStatus::State;

}  // namespace

FailureNotice::FailureNotice(Editor& editor, Simulation& simulation, MessageBar& messages,
                             Steps steps, QObject* parent)
    : QObject(parent),
      editor_(editor),
      simulation_(simulation),
      messages_(messages),
      steps_(std::move(steps)) {
  delay_.setSingleShot(true);
  delay_.setInterval(kDelay);
  connect(&delay_, &QTimer::timeout, this, &FailureNotice::show);
  connect(&editor, &Editor::rebuildChanged, this, &FailureNotice::follow);
  connect(&editor, &Editor::projectReplaced, this, [this] { messages_.withdraw(shown_); });
  connect(&simulation, &Simulation::activeChanged, this, [this](bool active) {
    if (active) show();
  });
}

void FailureNotice::follow() {
  const State state = editor_.rebuildStatus().state;
  if (state == State::kFailed) {
    if (!delay_.isActive()) delay_.start();
    return;
  }
  delay_.stop();
  if (state == State::kUpToDate) messages_.withdraw(shown_);
}

void FailureNotice::show() {
  const app::RebuildStatus status = editor_.rebuildStatus();
  QString text;
  std::vector<MessageBar::Action> actions;
  if (status.state == State::kFailed) {
    text = tr("The model cannot be built. %1").arg(failureText(status));
    for (Remedy& remedy : remediesOf(editor_))
      actions.push_back({remedy.text, remedy.tip, std::move(remedy.apply)});
    if (status.reason.isFree)
      actions.push_back({tr("Paint support"), tr("Choose in the view where the body is supported"),
                         steps_.paintSupport});
    if (status.reason.needsDensity)
      actions.push_back(
          {tr("Enter density …"), tr("Open the material with its density"), steps_.enterDensity});
  } else if (status.state == State::kCancelled && simulation_.isActive()) {
    text = waitingText(status);
    actions.push_back({tr("Build again"), tr("Build the model of the present shape"),
                       [this] { editor_.rebuildAgain(); }});
  } else {
    return;
  }
  QStringList buttons;  // a remedy may be found later
  for (const MessageBar::Action& action : actions) buttons << action.text;
  if (text == shown_ && buttons == buttons_ && messages_.messages().contains(text)) return;
  messages_.withdraw(shown_);
  shown_ = text;
  buttons_ = buttons;
  messages_.showError(text, std::move(actions));
}

}  // namespace palpa::gui

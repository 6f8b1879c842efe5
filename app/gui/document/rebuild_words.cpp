#include "app/gui/document/rebuild_words.h"

#include <algorithm>
#include <cmath>

#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

using State = app::RebuildStatus::State;

}  // namespace

int percent(double fraction) {
  return static_cast<int>(std::floor(100 * fraction));
}

bool isUpdate(const app::RebuildStatus& status) {
  return status.residual && status.modelRevision == status.revision;
}

QString failureText(const app::RebuildStatus& status) {
  if (status.reason.needsDensity)
    return tr("Gravity acts, but the material has no density; enter it, or remove the load.");
  QString text = QString::fromStdString(status.error);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  if (!text.endsWith('.')) text += '.';
  const auto errors = std::count_if(status.findings->begin(), status.findings->end(),
                                    [](const auto& finding) { return finding.isError; });
  if (status.stages.empty() || status.stages.back().phase != Phase::kCheck || errors == 0)
    return text;
  return text + ' ' +
         (errors > 1 ? tr("%Ln places are marked in the view.", nullptr, static_cast<int>(errors))
                     : tr("The place is marked in the view."));
}

QString rebuildText(const app::RebuildStatus& status) {
  switch (status.state) {
    case State::kEmpty:
      return tr("No model");
    case State::kBuilding:
      return (isUpdate(status) ? tr("Touchable, completing the model %1 %")
                               : tr("Building the model %1 %"))
          .arg(percent(status.progress));
    case State::kUpToDate:
      return tr("Up to date");
    case State::kFailed:
      return tr("Cannot be built");
    case State::kCancelled:
      return tr("Stopped");
  }
  return {};
}

QString waitingText(const app::RebuildStatus& status) {
  switch (status.state) {
    case State::kFailed:
      return tr("There is nothing to touch, because the model cannot be built. %1")
          .arg(failureText(status));
    case State::kCancelled:
      return tr(
          "There is nothing to touch, because the build was stopped. “Build again” in the Rebuild "
          "panel starts it.");
    default:
      return tr("Touching is possible as soon as the model is built (%1 %).")
          .arg(percent(status.progress));
  }
}

QString waitingHint(const app::RebuildStatus& status) {
  switch (status.state) {
    case State::kFailed:
      return tr("The model cannot be built; the message over the view says why");
    case State::kCancelled:
      return tr("The build was stopped; “Build again” in the Rebuild panel starts it");
    default:
      return tr("Touching is possible as soon as the first model is built");
  }
}

}  // namespace palpa::gui

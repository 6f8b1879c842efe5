#include "app/gui/document/accuracy_words.h"

#include <cmath>

#include "app/core/system/memory.h"
#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

using Limit = app::AccuracyAdvice::Limit;
using State = app::RebuildStatus::State;

constexpr double kMinPercent = 0.01;

QString memoryText(double bytes) {
  return std::isfinite(bytes) ? QString::fromStdString(app::formatBytes(bytes))
                              : tr("more memory than can be counted");
}

QString limitText(Limit limit) {
  switch (limit) {
    case Limit::kNone:
      return {};
    case Limit::kBuildTime:
      return tr("The number of spline elements is limited, so that a build takes seconds.");
    case Limit::kTouch:
      return tr("The mesh is too coarse for a fingertip: contacts are wider than requested.");
    case Limit::kElementLength:
      return tr("The project sets the size of the spline elements.");
    case Limit::kEdgeLength:
      return tr("The edges of the triangles are too long.");
    case Limit::kElementSize:
      return tr("The spline elements are too large for this body.");
  }
  return {};
}

/// Two significant digits: "about 5,600".
QString roundNumber(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(value, 1.0))) - 1);
  return tr("%L1").arg(std::round(value / unit) * unit, 0, 'f', 0);
}

QString durationText(double seconds) {
  if (seconds < 1) return tr("less than a second");
  if (seconds < 100) return tr("%1 s").arg(std::ceil(seconds));
  return tr("%1 minutes").arg(std::ceil(seconds / 60));
}

}  // namespace

QString percentText(double relative) {
  const double percent = 100 * relative;
  if (percent > 0 && percent < kMinPercent) return tr("below %L1 %").arg(kMinPercent);
  return tr("%L1 %").arg(percent, 0, percent >= 10 ? 'f' : 'g', percent >= 10 ? 0 : 2);
}

QString accuracyText(const app::RebuildStatus& status, double requested) {
  const QString wish = percentText(status.accuracy ? status.accuracy->requested : requested);
  if (status.touchError > 0)
    return tr("Accuracy: about %1 (requested %2)").arg(percentText(status.touchError), wish);
  if (status.residual)
    return tr("Accuracy: estimated after the full rebuild (requested %1)").arg(wish);
  return tr("Accuracy: being estimated (requested %1)").arg(wish);
}

QString accuracyReason(const app::RebuildStatus& status) {
  if (!status.accuracy || status.accuracy->limit == Limit::kNone) return {};
  const app::AccuracyAdvice& advice = *status.accuracy;
  QString text = limitText(advice.limit);
  const QString wish = percentText(advice.requested);
  const bool isMemory = advice.usableBytes > 0 && !(advice.neededBytes <= advice.usableBytes);
  if (isMemory)
    text += ' ' + tr("%1 needs about %2; %3 can be used.")
                      .arg(wish, memoryText(advice.neededBytes), memoryText(advice.usableBytes));
  if (advice.mesh && !advice.isEnough)
    text += ' ' + tr("About %1 can be reached.").arg(percentText(advice.expected));
  if (!advice.mesh && !isMemory) text += ' ' + tr("No finer mesh is possible.");
  return text;
}

bool canRefine(const app::RebuildStatus& status) {
  return status.state == State::kUpToDate && status.accuracy && status.accuracy->mesh;
}

QString refineTip(const app::RebuildStatus& status) {
  if (status.state != State::kUpToDate) return tr("Possible as soon as the model is up to date");
  if (!status.accuracy) return tr("Possible as soon as the accuracy is estimated");
  const app::AccuracyAdvice& advice = *status.accuracy;
  if (advice.limit == Limit::kNone) return tr("The requested accuracy is reached");
  if (!advice.mesh) return accuracyReason(status);
  QString text = advice.isEnough ? tr("A finer mesh for %1").arg(percentText(advice.requested))
                                 : tr("The finest mesh that is possible");
  text +=
      ": " + (advice.hasSplines ? tr("about %1 spline coefficients, %2") : tr("about %1 nodes, %2"))
                 .arg(roundNumber(advice.coefficients), memoryText(advice.bytes));
  if (advice.seconds > 0) text += ", " + durationText(advice.seconds);
  return text + ". " + tr("It can be undone.");
}

}  // namespace palpa::gui

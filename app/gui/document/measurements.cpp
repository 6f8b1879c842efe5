#include "app/gui/document/measurements.h"

#include <QClipboard>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <algorithm>

#include "app/gui/document/editor.h"
#include "app/gui/document/measurement_words.h"
#include "app/gui/document/named_items.h"
#include "modeling/error.h"

namespace palpa::gui {
namespace {

constexpr int kInterval = 40;   // ms between two announcements
constexpr double kShare = 4;    // interval over cost: a quarter of the time at most
constexpr int kLongest = 1000;  // ms

}  // namespace

Measurements::Measurements(Editor& editor) : QObject(&editor), editor_(editor) {
  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, &Measurements::changed);
  connect(&editor, &Editor::projectReplaced, this, [this] {
    body_.reset();
    results_.reset();
    Q_EMIT changed();
  });
  connect(&editor, &Editor::projectChanged, this, &Measurements::follow);
}

void Measurements::follow(const modeling::Change& change) {
  if (change.body()) body_.reset();
  if (!change.body() && !change.measurements) return;
  results_.reset();
  if (change.measurements) {
    soon_.stop();
    Q_EMIT changed();
    return;
  }
  if (editor_.project().measurements.empty() || soon_.isActive()) return;
  soon_.start(std::clamp(static_cast<int>(kShare * cost_), kInterval, kLongest));
}

const modeling::MeasuredBody& Measurements::body() {
  if (!body_) body_ = std::make_unique<modeling::MeasuredBody>(editor_.project().body);
  return *body_;
}

Measurements::Result Measurements::measure(const modeling::Measurement& measurement) {
  Result result;
  try {
    result.value = body().measure(measurement);
  } catch (const modeling::ModelingError& error) {
    result.problem = QString::fromStdString(error.what());
  }
  return result;
}

const std::vector<Measurements::Result>& Measurements::results() {
  if (!results_) {
    QElapsedTimer timer;
    timer.start();
    std::vector<Result> results;
    for (const modeling::Measurement& each : editor_.project().measurements)
      results.push_back(measure(each));
    results_ = std::move(results);
    cost_ = 1e-6 * static_cast<double>(timer.nsecsElapsed());
  }
  return *results_;
}

Measurements::Result Measurements::resultOf(const std::string& name) {
  const auto& list = editor_.project().measurements;
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return results()[i];
  return {};
}

void copyMeasurement(Editor& editor) {
  const auto& named = editor.selection().named;
  if (!named || named->kind != Selection::Kind::kMeasurement) return;
  const auto* measurement = findNamed(editor.project().measurements, named->name);
  const Measurements::Result result = editor.measurements().resultOf(named->name);
  if (!measurement || !result.value) {
    Q_EMIT editor.refused(result.problem);
    return;
  }
  QGuiApplication::clipboard()->setText(
      QString::fromStdString(named->name) + "\t" +
      dimensionText(measurement->kind, *result.value, editor.settings().units(), 10));
  Q_EMIT editor.said(
      Measurements::tr("Copied the value of “%1”").arg(QString::fromStdString(named->name)));
}

}  // namespace palpa::gui

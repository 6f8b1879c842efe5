#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/document/measurement_words.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/named_items.h"
#include "app/gui/properties/pages.h"

namespace palpa::gui {
namespace {

const modeling::Measurement* selected(const Editor& editor) {
  const auto& named = editor.selection().named;
  return named ? findNamed(editor.project().measurements, named->name) : nullptr;
}

/// Everything about the value, one fact per line, or why there is none.
QString valueText(Editor& editor) {
  const modeling::Measurement* measurement = selected(editor);
  if (!measurement) return {};
  const Measurements::Result result = editor.measurements().resultOf(measurement->name);
  if (!result.value) return result.problem;
  QStringList lines;
  for (const auto& [label, text] : factsOf(*measurement, *result.value, editor.settings().units()))
    lines << (lines.empty() ? text : tr("%1: %2").arg(label, text));
  return lines.join('\n');
}

QString placesText(const Editor& editor) {
  const modeling::Measurement* measurement = selected(editor);
  if (!measurement) return {};
  QStringList lines;
  for (const modeling::MeasuredPlace& place : measurement->places) lines << placeText(place);
  return lines.join('\n');
}

}  // namespace

void addMeasurementRows(PropertyPage& page) {
  Editor& editor = page.editor();
  page.addSection(tr("Measurement"));
  addNameRow(page);
  page.addFact(tr("Kind"), "kind", [&editor] {
    const modeling::Measurement* measurement = selected(editor);
    return measurement ? kindText(measurement->kind) : QString();
  });
  page.addFact(tr("Value"), "measuredValue", [&editor] { return valueText(editor); });
  page.addFact(tr("Places"), "places", [&editor] { return placesText(editor); });
  page.addButton(tr("&Copy value"), "copyValue", {}, [&editor] { copyMeasurement(editor); });
  QObject::connect(&editor.measurements(), &Measurements::changed, &page,
                   [&page] { page.refresh(); });
}

}  // namespace palpa::gui

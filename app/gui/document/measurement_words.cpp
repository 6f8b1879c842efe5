#include "app/gui/document/measurement_words.h"

#include <cmath>

#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

using modeling::MeasuredPlace;
using modeling::MeasuredValue;
using modeling::MeasurementKind;
using Fit = MeasuredValue::Fit;

QString radiusText(double radius, const ShownUnits& units, int digits) {
  if (std::isinf(radius)) return tr("flat");
  const QString text = shown(std::abs(radius), Quantity::kLength, units, digits);
  return radius < 0 ? tr("%1, hollow").arg(text) : text;
}

QString fitText(Fit fit) {
  switch (fit) {
    case Fit::kSphere:
      return tr("sphere through the vertices");
    case Fit::kCylinder:
      return tr("cylinder through the vertices");
    case Fit::kCircle:
      return tr("circle through the vertices");
    case Fit::kPolynomial:
      return tr("polynomial through the vertices nearby");
    case Fit::kNone:
      break;
  }
  return {};
}

}  // namespace

QString kindText(MeasurementKind kind) {
  return tr(modeling::infoOf(kind).label);
}

QString dimensionText(MeasurementKind kind, const MeasuredValue& value, const ShownUnits& units,
                      int digits) {
  switch (kind) {
    case MeasurementKind::kAngle:
      return shown(value.value, Quantity::kAngle, units, digits);
    case MeasurementKind::kRadius:
      return std::isinf(value.value) ? tr("flat") : "R " + radiusText(value.value, units, digits);
    case MeasurementKind::kDistance:
    case MeasurementKind::kLength:
    case MeasurementKind::kThickness:
      break;
  }
  return shown(value.value, Quantity::kLength, units, digits);
}

QString placeText(const MeasuredPlace& place) {
  const QString patch = QString::fromStdString(place.patch);
  switch (place.what) {
    case MeasuredPlace::What::kFace:
      return tr("face %1").arg(patch);
    case MeasuredPlace::What::kEdge:
      if (!place.side)
        return tr("edge between %1 and %2").arg(patch, QString::fromStdString(place.other));
      return tr("edge %1 of %2")
          .arg(QString::fromStdString(std::string(modeling::sideName(*place.side))), patch);
    case MeasuredPlace::What::kPoint:
      break;
  }
  return tr("point on %1").arg(patch);
}

std::vector<std::pair<QString, QString>> factsOf(const modeling::Measurement& measurement,
                                                 const MeasuredValue& value,
                                                 const ShownUnits& units) {
  constexpr int kDigits = 8;
  std::vector<std::pair<QString, QString>> facts{
      {tr("Value"), dimensionText(measurement.kind, value, units, kDigits)}};
  if (value.second) {
    switch (measurement.kind) {
      case MeasurementKind::kThickness:
        facts.emplace_back(tr("Ball inside"),
                           tr("⌀ %1").arg(shown(*value.second, Quantity::kLength, units, 6)));
        break;
      case MeasurementKind::kRadius:
        facts.emplace_back(tr("Across"), radiusText(*value.second, units, 6));
        break;
      case MeasurementKind::kLength:
        facts.emplace_back(tr("Whole edge"), shown(*value.second, Quantity::kLength, units, 6));
        break;
      case MeasurementKind::kDistance:
      case MeasurementKind::kAngle:
        break;
    }
  }
  const Quantity quantity =
      measurement.kind == MeasurementKind::kAngle ? Quantity::kAngle : Quantity::kLength;
  // Rounding noise has no digits worth reading.
  const bool isExact = value.accuracy <= 1e-9 * std::max(1.0, std::abs(value.value));
  if (std::isfinite(value.value))
    facts.emplace_back(tr("Accuracy"), isExact ? tr("exact to rounding")
                                               : "± " + shown(value.accuracy, quantity, units, 2));
  if (value.fit != Fit::kNone) facts.emplace_back(tr("From"), fitText(value.fit));
  return facts;
}

}  // namespace palpa::gui

#pragma once

#include <QString>
#include <QStringList>
#include <utility>
#include <vector>

#include "app/gui/base/units.h"
#include "modeling/measure/measured_body.h"

// Measurements in words.
namespace palpa::gui {

QString kindText(modeling::MeasurementKind kind);

/// Value as written on a dimension: "12.5 mm", "R 8 mm", "90°", "flat".
QString dimensionText(modeling::MeasurementKind kind, const modeling::MeasuredValue& value,
                      const ShownUnits& units, int digits = 5);

/// A place: "face top", "edge u-min of top", "point on top".
QString placeText(const modeling::MeasuredPlace& place);

/// Rows with everything about a value: label and text.
std::vector<std::pair<QString, QString>> factsOf(const modeling::Measurement& measurement,
                                                 const modeling::MeasuredValue& value,
                                                 const ShownUnits& units);

}  // namespace palpa::gui

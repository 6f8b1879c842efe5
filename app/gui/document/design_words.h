#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "app/core/design/shape_search.h"
#include "app/gui/base/units.h"
#include "modeling/project/design.h"

// Texts about the design of a project and the search for a shape.
namespace palpa::gui {

/// "1.25 N/mm" or "3 N": a value of a target in the chosen units.
QString targetValueText(modeling::DesignTarget::Kind kind, double value, const ShownUnits& units,
                        int digits = 4);
/// The same without the unit.
QString targetNumberText(modeling::DesignTarget::Kind kind, double value, const ShownUnits& units,
                         int digits = 4);
/// Unit of a target's value: "N/mm", "N".
Unit targetUnit(modeling::DesignTarget::Kind kind, const ShownUnits& units);
/// Wanted value: "1.25 N/mm", "3 N at 2.5 mm".
QString wantedText(const modeling::DesignTarget& target, const ShownUnits& units);

/// Which points may move, in a line.
QString pointsText(const std::optional<modeling::PointSelection>& points);

/// "the largest movement of 0.5 mm: …; the volume, which is kept".
QString limitsText(const std::vector<app::ShapeLimit>& limits);

/// Begins with a capital letter and ends with a full stop.
QString sentence(QString text);
/// An error about the design: the path in the file ("design.targets[0].touch: …") becomes the name
/// of the row in the panel ("Target 1, touch: …").
QString designProblem(const QString& message, const modeling::Design& design);

}  // namespace palpa::gui

#pragma once

#include <QString>
#include <QStringList>

#include "app/gui/base/units.h"
#include "app/gui/document/touch_gradient.h"

// Texts about the gradient of a stiffness.
namespace palpa::gui {

/// "0.884 N/mm", four digits.
QString stiffnessText(double stiffness, const ShownUnits& units);
/// "0.0312", three digits, in the unit of gradientText().
QString gradientNumber(double gradient, const ShownUnits& units);
/// "0.0312 N/mm per mm".
QString gradientText(double gradient, const ShownUnits& units);

/// Legend of the arrows: touch, stiffness, meaning and largest gradient, or what is missing.
/// `isSimulating`: the touch is in the view.
QStringList gradientLegend(const TouchGradient& gradient, bool isSimulating,
                           const ShownUnits& units);

/// Stiffness during a motion of control points, beside the stiffness at its start: "Grab 1: ≈ 0.912
/// N/mm (+3.2 %)". ≈: predicted by the gradient.
QString changedStiffnessText(const QString& name, const TouchGradient::Stiffness& stiffness,
                             double before, const ShownUnits& units);

}  // namespace palpa::gui

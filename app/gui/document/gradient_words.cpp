#include "app/gui/document/gradient_words.h"

#include <cmath>

#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

constexpr int kStiffnessDigits = 4, kGradientDigits = 3;

QString numberText(double value, const QString& unitOfProgram, const ShownUnits& units,
                   int digits) {
  const Unit unit = shownUnit(unitOfProgram, units);
  return QString::number(value / unit.factor, 'g', digits) + " " + unit.symbol;
}

}  // namespace

QString stiffnessText(double stiffness, const ShownUnits& units) {
  return numberText(stiffness, "N/mm", units, kStiffnessDigits);
}

QString gradientNumber(double gradient, const ShownUnits& units) {
  const Unit unit = shownUnit("N/mm per mm", units);
  return QString::number(gradient / unit.factor, 'g', kGradientDigits);
}

QString gradientText(double gradient, const ShownUnits& units) {
  return numberText(gradient, "N/mm per mm", units, kGradientDigits);
}

QStringList gradientLegend(const TouchGradient& gradient, bool isSimulating,
                           const ShownUnits& units) {
  if (const QString obstacle = gradient.obstacle(); !obstacle.isEmpty())
    return {tr("No stiffness gradient: %1").arg(obstacle)};
  if (!gradient.hasTouch())
    return {isSimulating ? tr("Stiffness gradient: touch the body")
                         : tr("Stiffness gradient: touch the body in Simulate mode (F5)")};
  const QString name = gradient.name();
  if (!gradient.problem().isEmpty())
    return {tr("No stiffness gradient of %1: %2").arg(name, gradient.problem())};
  if (!gradient.known()) return {tr("Stiffness gradient of %1: computing …").arg(name)};
  const TouchGradient::Known& known = *gradient.known();
  const double largest = known.gradient.colwise().norm().maxCoeff();
  QString first = tr("Stiffness gradient of %1").arg(QString::fromStdString(known.rule.name));
  if (const auto stiffness = gradient.stiffness(); stiffness && !isSimulating)
    first = (stiffness->isPredicted ? tr("Stiffness of %1: ≈ %2, predicted")
                                    : tr("Stiffness of %1: %2"))
                .arg(name, stiffnessText(stiffness->value, units));
  if (gradient.isOutdated())
    return {first, gradient.isUpdating() ? tr("Faint arrows: before the last change; updating …")
                                         : tr("Faint arrows: before the last change")};
  return {first, tr("Pull a control point along its arrow: stiffer, by up to %1")
                     .arg(gradientText(largest, units))};
}

QString changedStiffnessText(const QString& name, const TouchGradient::Stiffness& stiffness,
                             double before, const ShownUnits& units) {
  const double change = 100 * (stiffness.value / before - 1);
  const QString sign = change < 0 ? "−" : "+";
  return (stiffness.isPredicted ? tr("%1: ≈ %2 (%3%4 %)") : tr("%1: %2 (%3%4 %)"))
      .arg(name, stiffnessText(stiffness.value, units), sign,
           QString::number(std::abs(change), 'f', 1));
}

}  // namespace palpa::gui

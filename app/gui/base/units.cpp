#include "app/gui/base/units.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modeling/project/project.h"

namespace palpa::gui {
namespace {

/// Numbers smaller than this, in the program's unit, are rounding errors: in the order of Quantity.
constexpr std::array<double, kQuantityCount> kNoise{1e-9, 1e-9, 1e-12, 1e-12,
                                                    1e-9, 1e-9, 1e-9,  1e-12};

/// A symbol as typed on a keyboard: "m/s2" for "m/s²", "Nmm" for "N mm".
QString typed(QString symbol) {
  symbol.replace(QStringLiteral("²"), "2").replace(QStringLiteral("³"), "3");
  for (const QString& each : {QStringLiteral(" "), QStringLiteral("^"), QStringLiteral("·")})
    symbol.remove(each);
  return symbol;
}

}  // namespace

const std::array<QuantityInfo, kQuantityCount>& quantities() {
  const auto tr = [](const char* text) { return QCoreApplication::translate("Units", text); };
  static const std::array<QuantityInfo, kQuantityCount> infos{{
      {"length", tr("&Length:"), {{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}}},
      {"force", tr("&Force:"), {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}, {"lbf", 4.4482216152605}}},
      {"stress", tr("&Stress:"), {{"MPa", 1}, {"kPa", 1e-3}, {"Pa", 1e-6}, {"GPa", 1e3}}},
      {"angle", tr("&Angle:"), {{"°", std::numbers::pi / 180.0}, {"rad", 1}}},
      {"moment",
       tr("M&oment:"),
       {{"N mm", 1}, {"N m", 1e3}, {"mN m", 1}, {"lbf in", 4.4482216152605 * 25.4}}},
      {"acceleration",
       tr("Acc&eleration:"),
       {{"m/s²", 1}, {"mm/s²", 1e-3}, {"g", modeling::Gravity::kStandard}}},
      {"density", tr("&Density:"), {{"kg/m³", 1}, {"g/cm³", 1e3}}},
      {"number", {}, {{"", 1}}},
  }};
  return infos;
}

Unit shownUnit(const QString& programUnit, const ShownUnits& units) {
  if (const qsizetype per = programUnit.indexOf(" per "); per >= 0) {
    const QString below = programUnit.mid(per + 5);
    const Unit above = shownUnit(programUnit.left(per), units), found = shownUnit(below, units);
    if (found.symbol.isEmpty()) return {above.symbol + " per " + below, above.factor};
    return {above.symbol + " per " + found.symbol, above.factor / found.factor};
  }
  Unit result;
  const QStringList parts = programUnit.split('/');
  for (const QString& part : parts)
    for (std::size_t i = 0; i < kQuantityCount; ++i) {
      if (quantities()[i].units.front().symbol != part) continue;
      const Unit& chosen = units.of(static_cast<Quantity>(i));
      const bool isFirst = result.symbol.isEmpty();
      result.symbol = isFirst ? chosen.symbol : result.symbol + "/" + chosen.symbol;
      result.factor = isFirst ? chosen.factor : result.factor / chosen.factor;
    }
  return result;
}

QString shown(double value, Quantity quantity, const ShownUnits& units, int digits) {
  const Unit& unit = units.of(quantity);
  double number = value / unit.factor;
  // Rounding errors, and -0, are shown as 0.
  if (std::abs(value) < kNoise[static_cast<std::size_t>(quantity)]) number = 0.0;
  constexpr double kMaxPlain = 1e7;  // larger numbers are shown with a power of ten
  const double size = std::abs(number);
  const int before = size >= 1.0 && size < kMaxPlain ? static_cast<int>(std::log10(size)) + 1 : 0;
  const QString text = QString::number(number, 'g', std::max(digits, before));
  if (unit.symbol.isEmpty()) return text;
  return unit.symbol == "°" ? text + unit.symbol : text + " " + unit.symbol;
}

std::optional<double> parsed(const QString& text, Quantity quantity, const ShownUnits& units) {
  static const QRegularExpression form(
      QStringLiteral(R"(^\s*([+-]?[0-9.,]+(?:[eE][+-]?[0-9]+)?)\s*(.*)$)"));
  const QRegularExpressionMatch match = form.match(text);
  if (!match.hasMatch()) return std::nullopt;
  double factor = units.of(quantity).factor;
  if (const QString symbol = typed(match.captured(2)); !symbol.isEmpty()) {
    const auto& known = unitsOf(quantity);
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const Unit& unit) { return typed(unit.symbol) == symbol; });
    if (found == known.end()) return std::nullopt;
    factor = found->factor;
  }
  QString number = match.captured(1);
  if (!number.contains('.')) number.replace(',', '.');
  bool isNumber = false;
  const double value = number.toDouble(&isNumber) * factor;
  if (!isNumber || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace palpa::gui

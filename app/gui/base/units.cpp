#include "app/gui/base/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace palpa::gui {

std::span<const Unit> unitsOf(Quantity quantity) {
  static const std::vector<Unit> lengths{{"mm", 1}, {"cm", 10}, {"m", 1000}, {"in", 25.4}};
  static const std::vector<Unit> forces{
      {"N", 1}, {"mN", 1e-3}, {"kN", 1e3}, {"lbf", 4.4482216152605}};
  static const std::vector<Unit> stresses{{"MPa", 1}, {"kPa", 1e-3}, {"Pa", 1e-6}, {"GPa", 1e3}};
  static const std::vector<Unit> angles{{"°", std::numbers::pi / 180.0}, {"rad", 1}};
  static const std::vector<Unit> numbers{{"", 1}};
  switch (quantity) {
    case Quantity::kLength:
      return lengths;
    case Quantity::kForce:
      return forces;
    case Quantity::kStress:
      return stresses;
    case Quantity::kAngle:
      return angles;
    case Quantity::kNumber:
      break;
  }
  return numbers;
}

QString shown(double value, Quantity quantity, const ShownUnits& units, int digits) {
  const Unit& unit = units.of(quantity);
  double number = value / unit.factor;
  if (number == 0.0) number = 0.0;  // no "-0"
  // Up to ten million all digits before the point, rather than a power of ten.
  constexpr double kPlain = 1e7;
  const double size = std::abs(number);
  const int before = size >= 1.0 && size < kPlain ? static_cast<int>(std::log10(size)) + 1 : 0;
  const QString text = QString::number(number, 'g', std::max(digits, before));
  if (unit.symbol.isEmpty()) return text;
  return unit.symbol == "°" ? text + unit.symbol : text + " " + unit.symbol;
}

std::optional<double> parsed(const QString& text, Quantity quantity, const ShownUnits& units) {
  QString number = text.trimmed();
  double factor = units.of(quantity).factor;
  // The longest symbol that fits: "mN" and "N" both end in N.
  qsizetype longest = 0;
  for (const Unit& unit : unitsOf(quantity)) {
    const qsizetype length = unit.symbol.size();
    if (length > longest && number.endsWith(unit.symbol, Qt::CaseSensitive)) {
      longest = length;
      factor = unit.factor;
    }
  }
  number = number.chopped(longest).trimmed();
  if (!number.contains('.')) number.replace(',', '.');
  bool isNumber = false;
  const double value = number.toDouble(&isNumber) * factor;
  if (!isNumber || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace palpa::gui

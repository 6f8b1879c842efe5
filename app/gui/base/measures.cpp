#include "app/gui/base/measures.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

namespace palpa::gui {
namespace {

constexpr int kDigits = 5;
constexpr double kMaxPlain = 1e7;  // larger numbers are shown with a power of ten

QString shownPower(double value, int power, const QString& sign, const ShownUnits& units) {
  const Unit& length = units.of(Quantity::kLength);
  const double number = value / std::pow(length.factor, power);
  const double size = std::abs(number);
  const QLocale locale;
  if (size >= kMaxPlain || (size > 0 && size < 1e-4))
    return locale.toString(number, 'g', kDigits) + " " + length.symbol + sign;
  const int before = size >= 1 ? static_cast<int>(std::log10(size)) + 1 : 1;
  QString text = locale.toString(number, 'f', std::max(0, kDigits - before));
  // Remove trailing zeros.
  if (text.contains(locale.decimalPoint())) {
    while (text.endsWith('0')) text.chop(1);
    if (text.endsWith(locale.decimalPoint())) text.chop(1);
  }
  return text + " " + length.symbol + sign;
}

}  // namespace

QString shownArea(double area, const ShownUnits& units) {
  return shownPower(area, 2, QStringLiteral("²"), units);
}

QString shownVolume(double volume, const ShownUnits& units) {
  return shownPower(volume, 3, QStringLiteral("³"), units);
}

}  // namespace palpa::gui

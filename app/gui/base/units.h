#pragma once

#include <QString>
#include <array>
#include <optional>
#include <span>

// The units that people see. Everything inside the program is in mm, N, MPa and rad.
namespace palpa::gui {

enum class Quantity { kLength, kForce, kStress, kAngle, kNumber };

struct Unit {
  QString symbol;
  double factor = 1;  ///< of the program's own unit: shown number = own number / factor
};

/// The units a quantity can be shown in, the default first. kNumber has one without a symbol.
std::span<const Unit> unitsOf(Quantity quantity);

/// The unit each quantity is shown in, by its place in unitsOf(). A value; the one in force belongs
/// to the settings.
struct ShownUnits {
  std::array<int, 5> chosen{};
  const Unit& of(Quantity quantity) const {
    return unitsOf(quantity)[chosen[static_cast<std::size_t>(quantity)]];
  }
  bool operator==(const ShownUnits&) const = default;
};

/// "12.5 mm": up to `digits` significant digits, no trailing zeros. For display only.
QString shown(double value, Quantity quantity, const ShownUnits& units, int digits = 6);

/// Reads a number in the shown unit, or with any unit of the quantity written behind it ("0.5 cm",
/// "3e-2"); a comma is a decimal point when there is no point. Nothing when it is not a number.
std::optional<double> parsed(const QString& text, Quantity quantity, const ShownUnits& units);

}  // namespace palpa::gui

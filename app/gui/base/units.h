#pragma once

#include <QString>
#include <array>
#include <optional>
#include <vector>

// Units for display. All values inside the program are in mm, N, MPa, rad, N mm, m/s² and kg/m³.
namespace palpa::gui {

enum class Quantity {
  kLength,
  kForce,
  kStress,
  kAngle,
  kMoment,
  kAcceleration,
  kDensity,
  kNumber,
};
inline constexpr std::size_t kQuantityCount = 8;

struct Unit {
  QString symbol;
  double factor = 1;  ///< size in the program's unit: shown number = value / factor
};

struct QuantityInfo {
  const char* key;          ///< in the file of preferences
  QString label;            ///< in the preferences, with &; empty without a choice of units
  std::vector<Unit> units;  ///< the default first; kNumber has one unit without a symbol
};

/// All quantities, in the order of Quantity.
const std::array<QuantityInfo, kQuantityCount>& quantities();

inline const std::vector<Unit>& unitsOf(Quantity quantity) {
  return quantities()[static_cast<std::size_t>(quantity)].units;
}

/// Chosen unit of each quantity, as an index into unitsOf(). Settings::units() is the present
/// choice.
struct ShownUnits {
  std::array<int, kQuantityCount> chosen{};
  const Unit& of(Quantity quantity) const {
    return unitsOf(quantity)[chosen[static_cast<std::size_t>(quantity)]];
  }
  bool operator==(const ShownUnits&) const = default;
};

/// Chosen unit for a unit of the program, as in "mm", "N/mm" or "N/mm per mm"; a part behind "per"
/// without a choice stays, as "cm³". No symbol for "".
Unit shownUnit(const QString& programUnit, const ShownUnits& units);

/// "12.5 mm": up to `digits` significant digits, without trailing zeros.
QString shown(double value, Quantity quantity, const ShownUnits& units, int digits = 6);

/// Reads a number in the chosen unit, or followed by any unit of the quantity ("0.5 cm", "3e-2",
/// "1.1 g/cm3"). A comma is a decimal point unless the text has a point. Nothing if the text is not
/// a number.
std::optional<double> parsed(const QString& text, Quantity quantity, const ShownUnits& units);

}  // namespace palpa::gui

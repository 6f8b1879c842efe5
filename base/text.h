#pragma once

#include <Eigen/Core>
#include <charconv>
#include <cmath>
#include <string>

// Numbers and places as text, for messages and files. The decimal point is '.' whatever the locale:
// Qt sets the locale of the process to the user's, which changes printf() but not to_chars().
namespace palpa {

/// Shortest decimal text that reads back as the same number; negative zero is written as 0.
inline std::string numberText(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value == 0.0 ? 0.0 : value).ptr;
  return std::string(buffer, end);
}

/// `value` with that many significant digits, trailing zeros removed, as printf's %.<digits>g.
inline std::string roundedText(double value, int digits = 4) {
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr;
  return std::string(buffer, end);
}

/// Two significant digits, for messages about the size of errors.
inline std::string shortNumberText(double value) {
  return roundedText(value, 2);
}

/// "(1.5, -2, 30) mm": four significant digits per coordinate, for messages. Coordinates below
/// 1e-9 of the largest one are rounding errors and are written as 0.
inline std::string placeText(const Eigen::Vector3d& place) {
  const double noise = 1e-9 * place.cwiseAbs().maxCoeff();
  const auto shown = [&](int k) {
    return roundedText(std::abs(place[k]) <= noise ? 0.0 : place[k]);
  };
  std::string text;
  for (int k = 0; k < 3; ++k) text.append(k == 0 ? "(" : ", ").append(shown(k));
  return text.append(") mm");
}

}  // namespace palpa

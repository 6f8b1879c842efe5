#pragma once

#include <charconv>
#include <cstdio>
#include <string>

namespace palpa::modeling {

/// Shortest decimal text that reads back as the same number; negative zero is written as 0.
inline std::string numberText(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value == 0.0 ? 0.0 : value).ptr;
  return std::string(buffer, end);
}

/// Two significant digits, for messages about sizes of errors.
inline std::string shortNumberText(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2g", value);
  return buffer;
}

}  // namespace palpa::modeling

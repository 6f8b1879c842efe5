#include "app/cli/values.h"

#include <charconv>
#include <cmath>
#include <optional>

#include "app/cli/errors.h"

namespace palpa::cli {
namespace {

std::optional<double> number(std::string_view text) {
  // Quoted vectors may have spaces: "0, 0, 25".
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  // from_chars does not accept a leading plus sign, which users write.
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

double parseNumber(const std::string& option, const std::string& text) {
  const auto value = number(text);
  if (!value) throw UsageError(option + ": expected a number, found '" + text + "'");
  return *value;
}

double parsePositive(const std::string& option, const std::string& text) {
  const auto value = number(text);
  if (!value || *value <= 0) {
    throw UsageError(option + ": expected a number greater than zero, found '" + text + "'");
  }
  return *value;
}

int parseCount(const std::string& option, const std::string& text, int most) {
  int count = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, count);
  if (result.ec != std::errc() || result.ptr != end || count < 1 || count > most)
    throw UsageError(option + ": expected a whole number from 1 to " + std::to_string(most) +
                     ", found '" + text + "'");
  return count;
}

Eigen::Vector3d parseVector(const std::string& option, const std::string& text) {
  Eigen::Vector3d vector;
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = rest.find(',');
    const auto value = number(rest.substr(0, comma));
    const bool isLast = comma == std::string_view::npos;
    if (!value || isLast != (i == 2)) {
      throw UsageError(option + ": expected three numbers x,y,z, found '" + text + "'");
    }
    vector[i] = *value;
    if (!isLast) rest.remove_prefix(comma + 1);
  }
  return vector;
}

std::vector<Eigen::Vector3d> parseVectors(const std::string& option,
                                          const std::vector<std::string>& texts) {
  std::vector<Eigen::Vector3d> vectors;
  for (const std::string& text : texts) vectors.push_back(parseVector(option, text));
  return vectors;
}

}  // namespace palpa::cli

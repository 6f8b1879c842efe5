#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace palpa::modeling {

/// Limits for untrusted text.
struct JsonLimits {
  std::size_t bytes;
  std::size_t values;
  int depth;
  std::size_t keys = 10'000;        ///< in one object
  std::size_t textBytes = 100'000;  ///< of one string or key
};

/// Parses JSON. A first pass without memory use enforces the limits.
/// Throws ModelingError that begins with `source: ` if limits are exceeded, a key is repeated, a
/// number is beyond the range of double, or the text is not JSON (with line and column).
nlohmann::json parseGuarded(std::string_view text, const std::string& source,
                            const JsonLimits& limits);

/// Path of a step inside a JSON document, in the form `supports[0].kind`.
std::string joinPath(const std::string& path, const std::string& key);
std::string joinPath(const std::string& path, std::size_t index);

}  // namespace palpa::modeling

#pragma once

#include <span>
#include <vector>

namespace palpa::bem {

/// Some elements of a discretisation, and the displacement coefficients and traction slots of the
/// functions that are not zero on them. All ascending.
struct ElementPart {
  std::vector<int> elements, coefficients, slots;
};

/// Position of each of `count` indices in an ascending list of some of them; -1: not in the list.
inline std::vector<int> placesIn(std::span<const int> some, int count) {
  std::vector<int> places(count, -1);
  for (std::size_t k = 0; k < some.size(); ++k) places[some[k]] = static_cast<int>(k);
  return places;
}

/// The indices in [0, flags.size()) whose flag is `value`, ascending.
inline std::vector<int> indicesWhere(const std::vector<bool>& flags, bool value = true) {
  std::vector<int> indices;
  for (std::size_t k = 0; k < flags.size(); ++k)
    if (flags[k] == value) indices.push_back(static_cast<int>(k));
  return indices;
}

}  // namespace palpa::bem

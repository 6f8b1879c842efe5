#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace palpa::modeling {

/// Unique, not empty names: without a name the seventh becomes `fallback`_7; names that occur
/// several times get a number, as screw_1 and screw_2.
inline std::vector<std::string> uniqueNames(const std::vector<std::string>& names,
                                            const std::string& fallback) {
  std::map<std::string, int> uses;
  for (const std::string& name : names)
    if (!name.empty()) ++uses[name];
  std::set<std::string> taken;
  std::map<std::string, int> next;
  std::vector<std::string> result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool named = !names[i].empty();
    const std::string base = named ? names[i] : fallback;
    std::string name = base;
    if (!named || uses[base] > 1) {
      int number = named ? next[base] : static_cast<int>(i);
      do name = base + "_" + std::to_string(++number);
      while (uses.count(name) || taken.count(name));
      next[base] = number;
    }
    taken.insert(name);
    result.push_back(name);
  }
  return result;
}

}  // namespace palpa::modeling

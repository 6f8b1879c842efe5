#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpa::cli {

/// " (did you mean 'touch'?)" when one of the known words is nearly what was typed, or contains it;
/// empty otherwise. Capitals do not count. A slip is a letter too many, missing, wrong, or swapped
/// with its neighbour; one is forgiven per three letters.
std::string didYouMean(std::string_view typed, const std::vector<std::string>& known);

}  // namespace palpa::cli

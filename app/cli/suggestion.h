#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpa::cli {

/// " (did you mean 'touch'?)" if a known word contains the typed one or differs by few typing
/// errors; empty otherwise. Ignores case. A typing error is a letter too many, missing, wrong, or
/// swapped with its neighbour; one per three letters is accepted.
std::string didYouMean(std::string_view typed, const std::vector<std::string>& known);

}  // namespace palpa::cli

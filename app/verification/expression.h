#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace palpa::verification {

/// Value of an arithmetic expression in the notation of analytic.json: numbers, names, + - * / **
/// (binds to the right, tighter than a sign before it), parentheses, sqrt(…), and pi; at most
/// kMaxExpressionLength characters. Throws std::invalid_argument with the location of the
/// error.
double evaluate(const std::string& expression, const std::map<std::string, double>& names);

inline constexpr std::size_t kMaxExpressionLength = 10000;

}  // namespace palpa::verification

#pragma once
#include <map>
#include <string>

namespace palpa::bem::test {

/// Value of an arithmetic expression in the notation of data/analytic.json: numbers, names, + - * /
/// ** (binds to the right, tighter than a sign before it), parentheses, sqrt(…), and pi. Throws
/// std::invalid_argument with the place of a mistake.
double evaluate(const std::string& expression, const std::map<std::string, double>& names);

}  // namespace palpa::bem::test

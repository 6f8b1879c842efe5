#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// Parsers of option values. All throw UsageError with the option and the expected value.
namespace palpa::cli {

/// A finite number. Independent of the locale.
double parseNumber(const std::string& option, const std::string& text);

/// A finite number > 0.
double parsePositive(const std::string& option, const std::string& text);

/// A whole number from 1 to `most`.
int parseCount(const std::string& option, const std::string& text, int most);

/// Three finite numbers "x,y,z".
Eigen::Vector3d parseVector(const std::string& option, const std::string& text);

std::vector<Eigen::Vector3d> parseVectors(const std::string& option,
                                          const std::vector<std::string>& texts);

}  // namespace palpa::cli

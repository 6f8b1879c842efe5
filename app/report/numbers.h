#pragma once

#include <Eigen/Core>
#include <string>

// Numbers without the digits that their errors make uncertain. `error` is relative; 0 where it is
// not known: then four digits are shown.
namespace palpa::report {

std::string rounded(double value, double error);

/// All components in the decimals of the length.
std::string rounded(const Eigen::Vector3d& vector, double error);

/// A number of at most the size of `whole`, in the decimals of `whole`.
std::string inDecimalsOf(double value, double whole, double error);

/// "4.72 ± 0.03", "5 ± more than 100 %"; without the error where it is not known.
std::string withError(double value, double error);

/// "about 0.5 %".
std::string percentText(double error);

}  // namespace palpa::report

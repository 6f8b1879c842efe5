#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpa::view {

/// Errors of one series of refinements; all lists are of the same length, all numbers positive.
struct ErrorCurve {
  std::string name;
  std::vector<double> coefficients;
  std::vector<double> sizes;  ///< of the elements, mm
  std::vector<double> errors;
  int order = 1;  ///< for which a grey line of error ~ size^order is drawn
};

/// Draws errors of the displacement against the number of coefficients and against the size of the
/// elements, on logarithmic axes, as a PNG file that replaces an existing one. At most six curves.
///
/// Throws std::invalid_argument for malformed curves, NoDisplayError without a display, ViewError
/// if the file cannot be written.
void drawConvergence(const std::vector<ErrorCurve>& curves, const std::filesystem::path& path);

}  // namespace palpa::view

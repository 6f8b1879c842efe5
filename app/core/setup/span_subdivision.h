#pragma once

#include <vector>

// Subdivision of the knot spans of one chain into elements: numbers along a line alone.
namespace palpa::app {

/// Numbers of equal elements per span, where a span is `need` times as long as the largest element
/// allowed. The smallest numbers for which every cubic function, which spreads over four elements,
/// is about as narrow as on even elements of the largest size; single elements may be longer.
std::vector<int> elementCounts(const std::vector<double>& need);

/// Sizes of the elements that replace the outermost one along an edge, as parts of it: geometric,
/// growing by at most 2.5, the first `rim`, together 1.
std::vector<double> rimSizes(double rim);

/// A place where elements must be small, as the number of a span plus a fraction.
struct SizeMark {
  double at;
  double millimetres;  ///< per unit of `at`
  double size;         ///< requested there, mm
};

/// Halves an element until it is small enough at all marks (sizes may grow by 0.8 mm per mm of
/// distance from a mark) and appends the upper ends of its parts to `ends`.
void halveAtMarks(double low, double high, const std::vector<SizeMark>& marks,
                  std::vector<double>& ends);

}  // namespace palpa::app

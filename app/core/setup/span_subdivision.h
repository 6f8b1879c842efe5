#pragma once

#include <vector>

// How the knot spans of one strip are divided into elements: numbers along a line alone.
namespace palpa::app {

/// In how many equal parts each span is divided, when it needs `need` of the largest elements that
/// are allowed. As few as keep every cubic function, which spreads over four elements, as narrow as
/// those of the largest elements side by side; a single element may be longer than that.
std::vector<int> evenPieces(const std::vector<double>& need);

/// Sizes of the elements that replace the outermost one along an edge, as parts of it: geometric,
/// growing by at most 2.5, the first `rim`, together 1.
std::vector<double> rimSizes(double rim);

/// A place where elements must be small, as number of a span plus a fraction.
struct DivisionMark {
  double at;
  double millimetres;  ///< per unit of `at`
  double size;         ///< wanted there, mm
};

/// Halves an element until it is small enough at some marks (sizes may grow by 0.8 mm per mm of
/// distance) and adds the upper ends of its parts to `ends`.
void halveAtMarks(double low, double high, const std::vector<DivisionMark>& marks,
                  std::vector<double>& ends);

}  // namespace palpa::app

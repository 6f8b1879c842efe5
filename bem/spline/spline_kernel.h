#pragma once

#include <cstddef>

#include "bem/element/kelvin_sums.h"
#include "bem/spline/bspline_basis.h"

/// Inner loops that place quadrature points on spline elements, compiled once per instruction set.
namespace palpa::bem {

inline constexpr int kMaxElementFunctions = (kMaxSplineDegree + 1) * (kMaxSplineDegree + 1);
static_assert(kMaxFunctionsAlong == kMaxSplineDegree + 1);

/// Geometry and basis at quadrature points of one element.
struct PlacePointsTask {
  SpanPolynomials direction[2];
  const double* points;  ///< control points of the element's functions, 3 each, mm
  int count;             ///< number of quadrature points, a multiple of kElementLanes
  const double *u, *v;   ///< their parameters
  const double* weight;  ///< their weights in the parameter plane
  // Results:
  double* geometry;  ///< [kPointValues][count], see ElementPoints
  /// Products of the functions, [point][functionStride]; entries beyond the last function keep
  /// their values. Null if not needed.
  double* basis;
  int functionStride;  ///< a multiple of kElementLanes
};

/// Tabulates the functions of a span: values[point][function].
struct TabulateTask {
  SpanPolynomials polynomials;
  const double* points;  ///< parameters
  int count;             ///< at most kElementLanes
  double* values;
};

void placePointsBaseline(const PlacePointsTask&);
void tabulateBaseline(const TabulateTask&);
void placePointsAvx2(const PlacePointsTask&);
void tabulateAvx2(const TabulateTask&);
void placePointsAvx512(const PlacePointsTask&);
void tabulateAvx512(const TabulateTask&);

/// Fastest variants of the loops that this processor supports.
struct SplineKernel {
  void (*placePoints)(const PlacePointsTask&);
  void (*tabulate)(const TabulateTask&);
};
SplineKernel splineKernelForThisProcessor();

}  // namespace palpa::bem
